"""Twin of the passes."""

import numpy as np

from ...effect import Knobs
from ...pictures.canvas import Size, part_of
from ...pictures.sampling import bilinear, centres

TAPS = {
    **dict.fromkeys([(-1, -1), (1, -1), (-1, 1), (1, 1)], 0.125),
    **dict.fromkeys([(-2, -2), (2, -2), (-2, 2), (2, 2)], 0.03125),
    **dict.fromkeys([(0, -2), (-2, 0), (2, 0), (0, 2)], 0.0625),
    (0, 0): 0.125,
}
"""Offsets in pixels to weights (Jimenez 2014)."""
TENT = {(x, y): (2 - abs(x)) * (2 - abs(y)) / 16 for x in (-1, 0, 1) for y in (-1, 0, 1)}


def sizes(size: Size, levels: int) -> list[Size]:
    """Of the halved pictures; they end at a single pixel."""
    found = [part_of(size, 2)]
    while len(found) < levels and found[-1] != (1, 1):
        found.append(part_of(found[-1], 2))
    return found


def glare(image: np.ndarray, knobs: Knobs) -> np.ndarray:
    """The effect as a whole: (H, W, 3) scene-linear, without glare to with it."""
    larger = [image]
    for columns, rows in sizes((image.shape[1], image.shape[0]), int(knobs["levels"])):
        larger.append(_filtered(larger[-1], (rows, columns), TAPS))
    smaller = larger.pop()
    for picture in reversed(larger[1:]):
        smaller = _mixed(picture, smaller, float(knobs["spread"]))
    return _mixed(image, smaller, float(knobs["strength"]))


def _mixed(picture: np.ndarray, smaller: np.ndarray, share: float) -> np.ndarray:
    return (1 - share) * picture + share * _filtered(smaller, picture.shape[:2], TENT)


def _filtered(picture: np.ndarray, shape: tuple[int, ...], taps: dict[tuple[int, int], float]) -> np.ndarray:
    """A picture of another shape, each pixel a weighted sum of lookups about its place."""
    u, v = centres(*shape)
    rows, columns = picture.shape[:2]
    return sum((w * bilinear(picture, u + x / columns, v + y / rows) for (x, y), w in taps.items()), np.zeros(1))


TWINS = ()
