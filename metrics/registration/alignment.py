"""Finds the placement under which two images' edges coincide, and how sure it is.

Gauss–Newton on the edge tensors, coarse to fine, with the tested image's gradients as those of both (the inverse
compositional step: Baker & Matthews 2004). The tested image is the one with less noise, and what it has no edge at has
no say. How sure it is follows from how well parts of the image agree with each other: a jackknife over blocks, over
rows and over columns of the image, since an edge along a row is rounded to that row everywhere alike.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import map_coordinates, spline_filter

from .edges import gradients, tensors
from .resampling import reduce

BLUR = 0.8  # pixels, at every resolution
_COARSEST = 24  # pixels of the shorter side
_POINTS = 16_000  # with the strongest edges, at most
_MARGIN = 3  # pixels of the border in which filters see past it
_STEPS = 12
STILL = 4e-3
"""Pixels, a hundredth of what is looked for."""
_BANDS, _BLOCKS = 12, 6
_DAMPING = 1e-6
_NOTHING = 1e-12

SHIFT = np.eye(4)[:, :2]
ZOOM = np.array([[0.0], [0.0], [1.0], [1.0]])
STRETCH = np.array([[0.0], [0.0], [1.0], [-1.0]])
"""What may move: directions in (right, down, across − 1, upright − 1)."""


class Edges:
    """Two images' edges at one resolution, as equations for a placement.

    Parameters are (right, down, across − 1, upright − 1).

    Args:
        tested, reference: (H, W) luminance, finite, not negative.
        variance: (H, W) of the reference's noise, or None.
        valid: (H, W) bool, where the tested image is what was handed in.
    """

    def __init__(
        self, tested: np.ndarray, reference: np.ndarray, variance: np.ndarray | None, valid: np.ndarray
    ) -> None:
        height, width = self.shape = tested.shape
        mine, theirs = tensors(gradients(tested, BLUR), gradients(reference, BLUR, variance))
        down, right = np.gradient(mine, axis=1), np.gradient(mine, axis=2)
        strength = (down**2 + right**2).sum(axis=0)
        strength[~valid] = 0
        inner = np.zeros(strength.shape, bool)
        inner[_MARGIN:-_MARGIN, _MARGIN:-_MARGIN] = True
        strength[~inner] = 0
        count = min(_POINTS, int(np.count_nonzero(strength)))
        points = np.argpartition(strength.ravel(), -count)[-count:] if count else np.zeros(0, int)
        self.rows, self.columns = np.unravel_index(points, self.shape)
        self._y, self._x = self.rows - (height - 1) / 2, self.columns - (width - 1) / 2
        self._mine = mine[:, self.rows, self.columns]
        down, right = down[:, self.rows, self.columns], right[:, self.rows, self.columns]
        self._slopes = np.stack([-right, -down, right * self._x, down * self._y])
        self._theirs = [spline_filter(part) for part in theirs]
        border = max(height, width) / 2
        self.units = np.array([1.0, 1.0, 1 / border, 1 / border])
        """One pixel, in each parameter: of a scale, at the farther border."""

    def looked_up(self, placement: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The reference's tensors where the placement has the points, (3, n), and which of them it has."""
        right, down, across, upright = placement
        height, width = self.shape
        rows = (height - 1) / 2 + (1 + upright) * (self._y - down)
        columns = (width - 1) / 2 + (1 + across) * (self._x - right)
        there = (rows >= 1) & (rows <= height - 2) & (columns >= 1) & (columns <= width - 2)
        at = rows, columns
        found = [map_coordinates(part, at, order=3, mode="mirror", prefilter=False) for part in self._theirs]
        return np.array(found), there

    def slopes(self, placement: np.ndarray, free: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """How the tensors change with each free parameter, (p, 3, n), a pixel each, and what is left, (3, n)."""
        theirs, there = self.looked_up(placement)
        moving = np.tensordot((self.units[:, None] * free).T, self._slopes, axes=1)
        return moving * there, self._mine - theirs

    def correlation(self, placement: np.ndarray, among: np.ndarray) -> float:
        """How alike the tensors are at points that are there under another placement too, in [-1, 1]."""
        theirs, there = self.looked_up(placement)
        used = there & self.looked_up(among)[1]
        one, other = self._mine[:, used], theirs[:, used]
        power = float(np.sqrt((one**2).sum() * (other**2).sum()))
        return float((one * other).sum()) / power if power > 0 else 0.0


@dataclass(frozen=True)
class Fit:
    """A placement with its doubt, by what was free to move.

    Attributes:
        placement: (4,) right, down, across − 1, upright − 1.
        moved: (p,) how far, in pixels; a scale's: at the farther border.
        doubt: (p,) its standard errors.
        evidence: (p,) its share of the normal equations, the others being unknown: about as many pixels as there are of
            clear edges that show it.
    """

    placement: np.ndarray
    moved: np.ndarray
    doubt: np.ndarray
    evidence: np.ndarray


def search(edges: Edges, start: np.ndarray, free: np.ndarray, still: float = STILL) -> np.ndarray:
    """(4,) the placement at which the edges coincide, near `start`; NaN where there is none.

    Args:
        free: (4, p) directions in which the placement may move.
        still: pixels; a step below this ends the search.
    """
    placement = start.astype(float)
    for _ in range(_STEPS if free.size else 0):
        slopes, left = edges.slopes(placement, free)
        flat = slopes.reshape(len(slopes), -1)
        step = _solve(flat @ flat.T, flat @ left.ravel())
        placement = placement + edges.units * (free @ step)
        if not _plausible(placement, edges.shape):
            return np.full(4, np.nan)
        if np.abs(step).max() < still:
            break
    return placement


def assess(edges: Edges, placement: np.ndarray, free: np.ndarray) -> Fit:
    """How sure the free parameters of a placement are, by a jackknife over parts of the image.

    Args:
        placement: (4,) as `search` gives it.
        free: (4, p) directions in which it could move.
    """
    slopes, left = edges.slopes(placement, free)
    matrices = np.einsum("pjn,qjn->npq", slopes, slopes)
    vectors = np.einsum("pjn,jn->np", slopes, left)
    matrix, vector = matrices.sum(axis=0), vectors.sum(axis=0)
    doubt = np.zeros(free.shape[1])
    for labels, count in _parts(edges):
        # Sums by part: of products of every two parameters, and of every parameter with what is left.
        inner = np.array([np.bincount(labels, column, count) for column in matrices.reshape(len(labels), -1).T])
        outer = np.array([np.bincount(labels, column, count) for column in vectors.T])
        without = [_solve(matrix - inner[:, k].reshape(matrix.shape), vector - outer[:, k]) for k in range(count)]
        doubt = np.maximum(doubt, np.sqrt((count - 1) * np.var(without, axis=0)))
    moved = np.linalg.lstsq(free, placement / edges.units, rcond=None)[0]
    evidence = 1 / np.diag(np.linalg.inv(matrix + _NOTHING * np.eye(len(matrix))))
    return Fit(placement, moved, doubt, evidence)


def _parts(edges: Edges) -> Iterator[tuple[np.ndarray, int]]:
    """The image in blocks, in bands of rows and in bands of columns: labels of the points, and how many there are."""
    height, width = edges.shape
    rows, columns = edges.rows / height, edges.columns / width
    yield (rows * _BLOCKS).astype(int) * _BLOCKS + (columns * _BLOCKS).astype(int), _BLOCKS**2
    yield (rows * _BANDS).astype(int), _BANDS
    yield (columns * _BANDS).astype(int), _BANDS


def _solve(matrix: np.ndarray, vector: np.ndarray) -> np.ndarray:
    damping = _DAMPING * (np.trace(matrix) + 1.0)
    return np.linalg.solve(matrix + damping * np.eye(len(matrix)), vector)


def _plausible(placement: np.ndarray, shape: tuple[int, int]) -> bool:
    height, width = shape
    right, down, across, upright = placement
    return abs(right) < width / 3 and abs(down) < height / 3 and max(abs(across), abs(upright)) < 0.5


def pyramid(
    tested: np.ndarray, reference: np.ndarray, variance: np.ndarray | None, valid: np.ndarray
) -> list[tuple[int, Edges]]:
    """The edges at halved resolutions, the coarsest first, each with how many of the images' pixels one of its is wide.

    Arguments as of `Edges`.
    """
    found, factor = [], 1
    there = valid.astype(float)
    while True:
        found.append((factor, Edges(tested, reference, variance, there > 0.999)))
        if min(tested.shape) // 2 < _COARSEST:
            return found[::-1]
        factor *= 2
        tested, reference, there = reduce(tested, 2), reduce(reference, 2), reduce(there, 2)
        variance = None if variance is None else reduce(variance, 2) / 4
