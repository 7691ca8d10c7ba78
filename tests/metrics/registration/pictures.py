"""Pictures that are known at every point, so that a shift or another field of view can be planted exactly."""

from dataclasses import dataclass
from functools import cache

import numpy as np

SAMPLES = 8
"""Along a pixel's side."""
COUNT = 14


@dataclass(frozen=True)
class Lighting:
    """How a picture is lit.

    Attributes:
        sun, ambient: their strengths.
        shadows: whether every disc throws one, down and to the right.
        where: (x, y) in −1…1 where the sun's light is strongest.
    """

    sun: float = 1.0
    ambient: float = 0.3
    shadows: bool = True
    where: tuple[float, float] = (-0.5, -0.7)


@cache
def picture(
    side: int,
    *,
    right: float = 0.0,
    down: float = 0.0,
    across: float = 1.0,
    upright: float = 1.0,
    lighting: Lighting = Lighting(),
    moved: int | None = None,
) -> np.ndarray:
    """(side, side, 3) float64, not to be written to: discs on a floor, box-filtered over the pixels.

    Args:
        right, down: by how many pixels the content is shifted.
        across, upright: the scales of the tangents; above 1 more is seen.
        moved: a disc that lies 3 pixels from its place.
    """
    steps = (np.arange(side * SAMPLES) + 0.5) / SAMPLES - side / 2  # pixels from the centre
    x = (across * (steps - right) / (side / 2))[None]
    y = (upright * (steps - down) / (side / 2))[:, None]
    rng = np.random.default_rng(7)
    places, radii = rng.uniform(-0.8, 0.8, (COUNT, 2)), rng.uniform(0.08, 0.22, COUNT)
    colours = rng.uniform(0.1, 0.9, (COUNT, 3))
    if moved is not None:
        places[moved] += 3 / (side / 2)
    albedo = np.broadcast_to(np.array([0.5, 0.45, 0.4]), (len(steps), len(steps), 3)).copy()
    lit = np.ones(albedo.shape[:2])
    for (px, py), radius in zip(places, radii, strict=True):
        if lighting.shadows:
            lit[(x - px - radius / 2) ** 2 + (y - py - radius / 2) ** 2 < radius**2] = 0
    for (px, py), radius, colour in zip(places, radii, colours, strict=True):
        inside = (x - px) ** 2 + (y - py) ** 2 < radius**2
        albedo[inside] = colour
        lit[inside] = 1
    sx, sy = lighting.where
    sun = lighting.sun / (1 + (x - sx) ** 2 + (y - sy) ** 2)
    light = albedo * (sun * lit + lighting.ambient)[..., None]
    pixels = light.reshape(side, SAMPLES, side, SAMPLES, 3).mean(axis=(1, 3))
    pixels.flags.writeable = False
    return pixels


def noisy(truth: np.ndarray, seed: int = 0, batches: int = 8, noise: float = 0.15) -> np.ndarray:
    """(batches, H, W, 3) float32: independent batches, with relative noise that the channels share, as light has."""
    grains = np.random.default_rng(seed).normal(size=(batches, *truth.shape[:2], 1))
    return np.maximum(truth * (1 + noise * grains), 0).astype(np.float32)
