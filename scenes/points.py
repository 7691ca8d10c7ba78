"""The surface points a frame sees: what the G-buffer tells the oracles, with no renderer's types in it."""

from dataclasses import dataclass, fields, replace

import numpy as np


@dataclass(frozen=True, eq=False)
class SurfacePoints:
    """One point per pixel, of an image of H × W, row 0 at the top. All float32 unless said.

    Attributes:
        position: (H, W, 3) world space, metres; undefined where `shape` is −1.
        normal: (H, W, 3) unit shading normal, turned to the viewer's side where the material is double sided.
        view: (H, W, 3) unit direction to the viewer.
        base_color: (H, W, 3) linear reflectance.
        metallic, roughness, specular, occlusion: (H, W) each, 0…1.
        emission: (H, W, 3) radiance towards the viewer, W/(sr·m²); the environment's where nothing is hit.
        shape: (H, W) int32, index into `Scene.shapes`, −1 where nothing is hit.
        triangle: (H, W) int32, index into the shape's triangles, −1 where nothing is hit.
    """

    position: np.ndarray
    normal: np.ndarray
    view: np.ndarray
    base_color: np.ndarray
    metallic: np.ndarray
    roughness: np.ndarray
    specular: np.ndarray
    occlusion: np.ndarray
    emission: np.ndarray
    shape: np.ndarray
    triangle: np.ndarray

    @property
    def hit(self) -> np.ndarray:
        """(H, W) bool: where a surface is seen."""
        return self.shape >= 0

    def at(self, mask: np.ndarray) -> "SurfacePoints":
        """The points where `mask` (H, W) is true, flattened: (N, …) each."""
        return replace(self, **{f.name: getattr(self, f.name)[mask] for f in fields(self)})
