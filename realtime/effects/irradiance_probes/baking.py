"""Bakes the probes: six views from each, kept as irradiance along six axes."""

import numpy as np

from ...effect import Knobs
from ...lit_views import LitViews
from ...shadows.views import CUBE_FACES, cube_views
from ...stage import Stage
from .grid import Grid

AXES = np.array([axis for axis, _ in CUBE_FACES], dtype=np.float64)
BURIED = 0.5
"""A probe that sees backs over a larger share of its directions stands within something, and is left out."""


def bake_probes(stage: Stage, knobs: Knobs) -> np.ndarray:
    """(6, n, 4) float64: for +x −x +y −y +z −z irradiance over π of each probe; and 1, or 0 of one that is left out."""
    size = int(knobs["size"])
    places = Grid.of(stage.scene, float(knobs["spacing"])).places()
    views = LitViews(stage, 6, (size, size), np.append(places[0], 1.0), float(knobs["ambient"]))
    kept = np.zeros((6, len(places), 4))
    for number, place in enumerate(places):
        matrices = cube_views(stage.scene, place, size, border=0).matrices
        views.move(np.append(place, 1.0))
        views.draw(list(matrices))
        radiance = faces_of(stage.device.read(views.texture), views.columns, size)[..., :3]
        weights = cosine_weights(matrices, place, size)
        kept[:, number, :3] = np.einsum("afyx,fyxc->ac", weights, radiance)
        kept[:, number, 3] = _sees_fronts(stage, views, size)
    return kept


def faces_of(image: np.ndarray, columns: int, size: int) -> np.ndarray:
    """(6, size, size, C) the faces of an image with row 0 at the top; their own rows run upwards."""
    upwards = image[::-1]
    corners = [(face // columns * size, face % columns * size) for face in range(6)]
    return np.stack([upwards[row : row + size, column : column + size] for row, column in corners])


def cosine_weights(matrices: np.ndarray, place: np.ndarray, size: int) -> np.ndarray:
    """(6 axes, 6 faces, size, size) by which radiance adds up to irradiance over π: max(ω·a, 0)·dω/π.

    A texel of a face takes 4/size²·(1 + x² + y²)^(−3/2); each axis's weights are scaled to add up to 1, as they do for
    small texels.
    """
    across = (np.arange(size) + 0.5) / size * 2 - 1
    y, x = np.meshgrid(across, across, indexing="ij")
    ends = np.stack([x, y, np.ones_like(x), np.ones_like(x)], axis=-1)
    there = np.einsum("fij,yxj->fyxi", np.linalg.inv(matrices), ends)
    towards = there[..., :3] / there[..., 3:] - place
    towards /= np.linalg.norm(towards, axis=-1, keepdims=True)
    cosines = np.maximum(np.einsum("fyxi,ai->afyx", towards, AXES), 0)
    weights = cosines * (1 + x**2 + y**2) ** -1.5
    return weights / weights.sum(axis=(1, 2, 3), keepdims=True)


def _sees_fronts(stage: Stage, views: LitViews, size: int) -> float:
    """1, or 0 where the probe is buried. Where no light asks for normals, nothing tells."""
    if views.normal is None:
        return 1.0
    normals = faces_of(stage.device.read(views.normal), views.columns, size)[..., :3]
    there = faces_of(stage.device.read(views.position), views.columns, size)[..., 3] > 0
    backs = there & (np.abs(normals).max(axis=-1) == 0)
    return float(backs.mean() <= BURIED)
