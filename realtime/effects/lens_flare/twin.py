"""Twins of the passes, and of the ghosts' weight."""

import numpy as np

from ...effect import Knobs
from ...pictures.blocks import bright_blocks, with_blocks
from ...pictures.sampling import bilinear, centres
from ...twin import Argument, Twin, uniform


def ghost_weight(away: np.ndarray) -> np.ndarray:
    """How bright a ghost of what lies so far from the middle is; distances in pictures' sides, corners at √½."""
    return np.maximum(1 - away / 0.70710678, 0.0) ** 2


def glare(image: np.ndarray, knobs: Knobs) -> np.ndarray:
    """The effect as a whole: (H, W, 3) scene-linear, without flare to with it."""
    divisor = int(knobs["divisor"])
    device_rows = image[::-1]
    bright = bright_blocks(device_rows, float(knobs["threshold"]), divisor)
    return with_blocks(device_rows, _ghosts(bright, knobs), float(knobs["strength"]), divisor)[::-1]


def _ghosts(bright: np.ndarray, knobs: Knobs) -> np.ndarray:
    rows, columns = bright.shape[:2]
    mirrored = 1 - np.stack(centres(rows, columns))
    inward = 0.5 - mirrored
    away = np.linalg.norm(inward, axis=0)
    direction = np.where(away > 0, inward / np.maximum(away, 1e-300), 0.0)
    places = [mirrored + inward * float(knobs["dispersal"]) * i for i in range(int(knobs["ghosts"]))]
    if knobs["halo"]:
        places.append(mirrored + direction * float(knobs["halo"]) * np.array([rows / columns, 1.0])[:, None, None])
    sums = np.zeros_like(bright)
    for place in places:
        weight = ghost_weight(np.linalg.norm(0.5 - place, axis=0))
        for channel in range(3):
            u, v = place + direction * float(knobs["chroma"]) * (channel - 1)
            inside = (u >= 0) & (v >= 0) & (u < 1) & (v < 1)
            sums[..., channel] += np.where(inside, bilinear(bright, u, v)[..., channel], 0.0) * weight
    return sums


TWINS = (
    Twin(
        "ghost_weight.glsl",
        "ghost_weight",
        "float",
        (Argument("away", "float", uniform(0.0, 1.0), (0.0, 0.70710678, 0.75)),),
        ghost_weight,
        cancels=1.0,
        roundings=2.5 + 1 + 1,
        why="the division (2.5), from 1, the square",
    ),
)
