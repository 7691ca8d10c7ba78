"""Where the probes stand."""

import math
from dataclasses import dataclass

import numpy as np

from lightmeter.scenes.model import Scene

from ...effect import EffectError

MOST = 4096
"""Probes that are baked at most: each is six views of the scene."""


@dataclass(frozen=True, eq=False)
class Grid:
    """The middles of equal cells that fill the scene's bounding box: so none lies in a wall that bounds it.

    Attributes:
        low: (3,) float64, the first probe.
        step: (3,) metres between neighbours.
        counts: (3,) how many there are each way.
    """

    low: np.ndarray
    step: np.ndarray
    counts: np.ndarray

    @classmethod
    def of(cls, scene: Scene, spacing: float) -> "Grid":
        """The grid whose probes lie no farther apart than a share of the scene's longest side.

        Raises:
            EffectError: there would be too many.
        """
        low, high = (np.asarray(corner, np.float64) for corner in scene.bounds)
        extent = np.maximum(high - low, 1e-9)
        counts = np.array([max(1, math.ceil(side / (spacing * extent.max()) - 1e-9)) for side in extent])
        if counts.prod() > MOST:
            raise EffectError(
                f"irradiance_probes.spacing: {spacing:g} makes {counts.prod()} probes, expected {MOST} at most; "
                "take a larger one"
            )
        step = extent / counts
        return cls(low + step / 2, step, counts)

    def places(self) -> np.ndarray:
        """(n, 3) float64: every probe, x first, then y, then z."""
        z, y, x = np.meshgrid(*(np.arange(count) for count in self.counts[::-1]), indexing="ij")
        return self.low + self.step * np.stack([x, y, z], axis=-1).reshape(-1, 3)
