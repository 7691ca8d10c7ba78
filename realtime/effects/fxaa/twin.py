"""Twin of the pass."""

import numpy as np

from ...effect import Knobs
from ...pictures.sampling import bilinear

LUMA = np.array([0.299, 0.587, 0.114])
"""Rec. 601's, of code values."""


def coverage(codes: np.ndarray, knobs: Knobs) -> np.ndarray:
    """The effect as a whole: (H, W, 3) code values 0…1, row 0 at the top, to filtered ones."""
    picture = _Picture(codes[::-1])
    shown = picture.image.copy()
    place = picture.places
    m = picture.luma_at(*place)
    n, s, e, w = (picture.luma_at(place[0] + x, place[1] + y) for x, y in ((0, 1), (0, -1), (1, 0), (-1, 0)))
    brightest = np.max([m, n, s, e, w], axis=0)
    contrast = brightest - np.min([m, n, s, e, w], axis=0)
    edges = contrast >= np.maximum(float(knobs["darkest"]), float(knobs["threshold"]) * brightest)
    if edges.any():
        x, y = (coordinate[edges] for coordinate in place)
        around = [values[edges] for values in (m, n, s, e, w, contrast)]
        shown[edges] = _blended(picture, x, y, around, knobs)
    return shown[::-1]


class _Picture:
    """Code values, row 0 the lowest, as the shader looks them up."""

    def __init__(self, image: np.ndarray) -> None:
        self.image = np.asarray(image, np.float64)
        self._luma = (self.image @ LUMA)[..., None]
        height, width = self.image.shape[:2]
        self.places = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
        self._size = width, height

    def at(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """(…, 3) at places in pixels."""
        return bilinear(self.image, x / self._size[0], y / self._size[1])

    def luma_at(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """(…) at places in pixels."""
        return bilinear(self._luma, x / self._size[0], y / self._size[1])[..., 0]


def _blended(picture: _Picture, x: np.ndarray, y: np.ndarray, around: list[np.ndarray], knobs: Knobs) -> np.ndarray:
    """(N, 3): the pixels at edges."""
    m, n, s, e, w, contrast = around
    ne, nw, se, sw = (picture.luma_at(x + i, y + j) for i, j in ((1, 1), (-1, 1), (1, -1), (-1, -1)))
    fine = np.clip(np.abs((2 * (n + s + e + w) + ne + nw + se + sw) / 12 - m) / np.maximum(contrast, 1e-30), 0, 1)
    fine = (fine * fine * (3 - 2 * fine)) ** 2 * float(knobs["smoothing"])
    along_x = np.abs(nw + sw - 2 * w) + 2 * np.abs(n + s - 2 * m) + np.abs(ne + se - 2 * e)
    along_y = np.abs(nw + ne - 2 * n) + 2 * np.abs(w + e - 2 * m) + np.abs(sw + se - 2 * s)
    horizontal = along_x >= along_y

    ahead, behind = np.where(horizontal, n, e), np.where(horizontal, s, w)
    back = np.abs(behind - m) >= np.abs(ahead - m)
    ahead, sign = np.where(back, behind, ahead), np.where(back, -1.0, 1.0)
    across = np.where(horizontal, 0.0, sign), np.where(horizontal, sign, 0.0)
    along = horizontal.astype(float), 1.0 - horizontal
    edge, least = 0.5 * (ahead + m), 0.25 * np.abs(ahead - m)

    def end(sign: float) -> tuple[np.ndarray, np.ndarray]:
        reach = int(knobs["reach"])
        distance, difference, open_ = np.full(x.shape, float(reach)), np.zeros(x.shape), np.ones(x.shape, bool)
        for walked in range(1, reach + 1):
            there = picture.luma_at(
                x + 0.5 * across[0] + sign * walked * along[0], y + 0.5 * across[1] + sign * walked * along[1]
            )
            difference = np.where(open_, there - edge, difference)
            ended = open_ & (np.abs(difference) >= least)
            distance[ended] = walked
            open_ &= ~ended
        return distance, difference

    (left, left_luma), (right, right_luma) = end(-1.0), end(1.0)
    nearer, luma = np.minimum(left, right), np.where(left < right, left_luma, right_luma)
    slant = np.where((luma < 0) != (m < edge), 0.5 - nearer / (left + right), 0.0)
    moved = np.maximum(slant, fine)
    return picture.at(x + moved * across[0], y + moved * across[1])


TWINS = ()
