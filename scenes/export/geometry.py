"""Meshes as accessors into one binary buffer (glTF 2.0, sections 3.6 and 3.7)."""

from typing import Any

import numpy as np

from ..model import IDENTITY, Mesh, Shape

FLOAT, UNSIGNED_INT = 5126, 5125
ARRAY_BUFFER, ELEMENT_ARRAY_BUFFER = 34962, 34963
TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}

SHEAR = 1e-6
"""Cosine between a matrix's axes; float64 rounding of a chain of rotations and scales stays far below."""


def placed(shape: Shape) -> tuple[Mesh, np.ndarray]:
    """The mesh to write, and where its node stands, (4, 4) float64.

    A node's matrix must be a translation, rotation and scale (section 3.5.2). Where it shears or
    flattens, the triangles are written in world space instead, as both renderers see them.
    """
    lengths = np.linalg.norm(shape.matrix[:3, :3], axis=0)
    axes = shape.matrix[:3, :3] / np.where(lengths > 0, lengths, 1)
    upright = np.abs(axes.T @ axes - np.eye(3)).max() <= SHEAR
    return (shape.mesh, shape.matrix) if upright else (shape.world, IDENTITY)


class Geometry:
    """The buffer of one file, with the accessors that look into it; each mesh is written once.

    Attributes:
        binary: the buffer.
        views, accessors: glTF's `bufferViews` and `accessors`.
    """

    def __init__(self):
        self.binary = bytearray()
        self.views: list[dict[str, Any]] = []
        self.accessors: list[dict[str, Any]] = []
        self._primitives: dict[Mesh, dict[str, Any]] = {}

    def primitive(self, mesh: Mesh) -> dict[str, Any]:
        """The primitive of a mesh, without its material; the mesh has at least one triangle.

        A flat mesh has no NORMAL, which is how glTF says flat (3.7.2.1), and no TANGENT, which means nothing then.
        """
        if mesh not in self._primitives:
            attributes = {"POSITION": self._attribute(mesh.positions, bounds=True)}
            if mesh.normals is not None:
                attributes["NORMAL"] = self._attribute(mesh.normals)
                if mesh.tangents is not None:
                    attributes["TANGENT"] = self._attribute(mesh.tangents)
            for number, texcoords in enumerate(mesh.texcoords):
                attributes[f"TEXCOORD_{number}"] = self._attribute(texcoords)
            if mesh.colors is not None:
                attributes["COLOR_0"] = self._attribute(mesh.colors)
            indices = self._accessor(mesh.triangles.reshape(-1, 1), "<u4", UNSIGNED_INT, ELEMENT_ARRAY_BUFFER)
            self._primitives[mesh] = {"attributes": attributes, "indices": indices}
        return dict(self._primitives[mesh])

    def _attribute(self, values: np.ndarray, *, bounds: bool = False) -> int:
        index = self._accessor(values, "<f4", FLOAT, ARRAY_BUFFER)
        if bounds:
            self.accessors[index] |= {"min": values.min(axis=0).tolist(), "max": values.max(axis=0).tolist()}
        return index

    def _accessor(self, values: np.ndarray, dtype: str, component: int, target: int) -> int:
        """Appends (N, width) values of four bytes each, so that every view is aligned; gives the accessor's number."""
        data = values.astype(dtype).tobytes()
        self.views.append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data), "target": target})
        self.binary += data
        count, width = values.shape
        accessor = {"bufferView": len(self.views) - 1, "componentType": component, "count": count}
        self.accessors.append(accessor | {"type": TYPES[width]})
        return len(self.accessors) - 1
