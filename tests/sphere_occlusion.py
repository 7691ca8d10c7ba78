"""How much of the light from everywhere a sphere takes from a plane, in closed form and by quadrature."""

import numpy as np


def hidden_by_sphere(distance: np.ndarray, cosine: np.ndarray, radius: float) -> np.ndarray:
    """The cosine-weighted share of a point's hemisphere that a sphere covers, the part below the horizon left out.

    A plane element's form factor to a sphere (Hamilton & Morgan 1952; Howell's catalogue, B-43): cos θ/h²,
    with h the distance over the radius, while the sphere is above the horizon.

    Args:
        distance: from the point to the sphere's centre, more than the radius.
        cosine: of the angle between the normal and the direction to the centre; part of it must be above the horizon.
    """
    h = distance / radius
    root, sine = np.sqrt(h * h - 1), np.sqrt(1 - cosine * cosine)
    whole = cosine / h**2
    with np.errstate(invalid="ignore", divide="ignore"):
        clipped = (
            0.5
            - np.arcsin(np.clip(root / (h * sine), -1, 1)) / np.pi
            + (
                cosine * np.arccos(np.clip(-root * cosine / sine, -1, 1))
                - root * np.sqrt(np.maximum(1 - h * h * cosine * cosine, 0))
            )
            / (np.pi * h * h)
        )
    return np.where(cosine * h >= 1, whole, clipped)


def hidden_by_quadrature(distance: float, cosine: float, radius: float, count: int = 1200) -> float:
    """The same, summed over a grid of the hemisphere's projection, whose every cell counts alike."""
    side = (np.arange(count) + 0.5) / count * 2 - 1
    x, y = np.meshgrid(side, side)
    inside = x * x + y * y < 1
    z = np.sqrt(np.maximum(1 - x * x - y * y, 0))
    towards = x * np.sqrt(1 - cosine**2) + z * cosine
    hit = towards > np.sqrt(1 - (radius / distance) ** 2)
    return float((hit & inside).sum() / inside.sum())
