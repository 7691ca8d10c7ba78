"""Which share of all directions is open at vertices: a depth map from each of many, seen from infinitely far away."""

import numpy as np

from ...shadows.casters import Casters
from ...stage import Stage


def directions(count: int) -> np.ndarray:
    """(n, 3) unit vectors, evenly over the sphere (a Fibonacci lattice, Swinbank & Purser 2006)."""
    index = np.arange(count) + 0.5
    z, turn = 1 - 2 * index / count, np.pi * (1 + np.sqrt(5)) * index
    across = np.sqrt(1 - z * z)
    return np.stack([across * np.cos(turn), across * np.sin(turn), z], axis=1)


def view_from(direction: np.ndarray, centre: np.ndarray, radius: float) -> np.ndarray:
    """(4, 4) world to clip space of parallel rays that come from a direction, over a ball."""
    right = np.cross(direction, np.eye(3)[np.argmin(np.abs(direction))])
    right /= np.linalg.norm(right)
    axes = np.stack([right, np.cross(direction, right), -direction]) / radius
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = axes, -axes @ centre
    return matrix


class Sky:
    """The depth maps of a scene, one after another in one texture.

    Args:
        side: texels.
    """

    def __init__(self, stage: Stage, side: int) -> None:
        low, high = stage.scene.bounds
        self._centre, self._radius = (low + high) / 2, float(np.linalg.norm(high - low)) / 2 * 1.001
        self._device, self._casters = stage.device, Casters(stage)
        self._depth = stage.device.depth((side, side))
        self._framebuffer = stage.device.framebuffer([], self._depth)
        self.texel = 2 * self._radius / side

    def open_shares(self, positions: np.ndarray, normals: np.ndarray, count: int) -> np.ndarray:
        """(N,) float64: the cosine-weighted share of the directions above each normal that nothing blocks.

        Args:
            positions, normals: (N, 3), world space, already moved off their own surface.
        """
        seen, all_of_it = np.zeros(len(positions)), np.zeros(len(positions))
        for direction in directions(count):
            weight = np.maximum(normals @ direction, 0)
            matrix = view_from(direction, self._centre, self._radius)
            facing = weight > 0
            seen[facing] += weight[facing] * self._lit(matrix, positions[facing])
            all_of_it += weight
        return np.where(all_of_it > 0, seen / np.maximum(all_of_it, 1e-300), 1)

    def _lit(self, matrix: np.ndarray, positions: np.ndarray) -> np.ndarray:
        """(N,) whether nothing lies between positions and the direction."""
        gl = self._device.gl
        self._framebuffer.use()
        self._framebuffer.clear()
        gl.enable_only(gl.DEPTH_TEST)
        self._casters.draw({"view_projection": matrix}, None)
        depth = self._device.read(self._depth)[::-1, :, 0]
        place = (positions @ matrix[:3, :3].T + matrix[:3, 3] + 1) / 2
        column, row = np.clip((place[:, :2] * len(depth)).astype(int), 0, len(depth) - 1).T
        return place[:, 2] <= depth[row, column]
