"""The surface points a frame sees: what the G-buffer tells the oracles, with no renderer's types in it."""

from collections.abc import Callable
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
        clearcoat, clearcoat_roughness: (H, W) each, 0…1; None where the scene has no coats.
        clearcoat_normal: (H, W, 3) unit normal of the coat, turned as `normal` is; None where it is that everywhere.
        anisotropy: (H, W) strength, 0…1; None where no material has a grain.
        anisotropy_direction: (H, W, 3) unit, along the grain, across `normal`; None likewise.
        sheen_color, sheen_roughness: (H, W, 3) and (H, W), 0…1; None where no material has a sheen.
        ior: (H, W) of the solid that the surface bounds, 0 where it is opaque; None where no material is glass.
        absorption: (H, W, 3) of its inside, 1/m; None likewise.
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
    clearcoat: np.ndarray | None = None
    clearcoat_roughness: np.ndarray | None = None
    clearcoat_normal: np.ndarray | None = None
    anisotropy: np.ndarray | None = None
    anisotropy_direction: np.ndarray | None = None
    sheen_color: np.ndarray | None = None
    sheen_roughness: np.ndarray | None = None
    absorption: np.ndarray | None = None
    ior: np.ndarray | None = None

    @property
    def hit(self) -> np.ndarray:
        """(H, W) bool: where a surface is seen."""
        return self.shape >= 0

    def at(self, mask: np.ndarray) -> "SurfacePoints":
        """The points where `mask` (H, W) is true, flattened: (N, …) each."""
        return self.each(lambda array: array[mask])

    def each(self, change: Callable[[np.ndarray], np.ndarray]) -> "SurfacePoints":
        """The same points with `change` applied to every array that is there."""
        arrays = {f.name: getattr(self, f.name) for f in fields(self)}
        return replace(self, **{name: change(a) for name, a in arrays.items() if a is not None})
