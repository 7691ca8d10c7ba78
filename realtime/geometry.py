"""The scene's triangles and textures on the device."""

from collections.abc import Collection
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from lightmeter.scenes.model import Image, Material, Mesh, Scene, Texture
from lightmeter.scenes.optics.color import srgb_decode

from .device import Device
from .effect import Knobs

GL_SRGB8_ALPHA8 = 0x8C43
FILTERS = {
    "nearest": 0x2600,
    "linear": 0x2601,
    "nearest_mipmap_nearest": 0x2700,
    "linear_mipmap_nearest": 0x2701,
    "nearest_mipmap_linear": 0x2702,
    "linear_mipmap_linear": 0x2703,
}


@dataclass(frozen=True, eq=False)
class Batch:
    """One shape, ready to draw.

    Attributes:
        attributes: name to (format, buffer), for the vertex array of any program.
        buffers: name to buffer object.
        count: how many vertices are drawn.
    """

    shape: int
    material: Material
    buffers: dict[str, tuple[str, Any]]
    indices: Any | None
    count: int

    @property
    def has(self) -> frozenset[str]:
        """The attributes it has beyond the position."""
        return frozenset(self.buffers) - {"position"}

    def vertices(self, device: Device, program):
        """A vertex array of just those attributes that the program reads."""
        content = [(buffer, fmt, name) for name, (fmt, buffer) in self.buffers.items() if name in program]
        return device.gl.vertex_array(program, content, self.indices)


@dataclass(frozen=True, eq=False)
class Solid:
    """The positions of every opaque shape in one buffer, for passes that need nothing else.

    Attributes:
        spans: shape to (first index, number of indices).
    """

    positions: Any
    indices: Any
    spans: dict[int, tuple[int, int]]

    def vertices(self, device: Device, program):
        """A vertex array for a program that reads `position`."""
        return device.gl.vertex_array(program, [(self.positions, "3f", "position")], self.indices)

    def ranges(self, shapes: Collection[int]) -> list[tuple[int, int]]:
        """(first, count) of the indices of some shapes, in as few pieces as there can be."""
        pieces: list[tuple[int, int]] = []
        for shape, (first, count) in self.spans.items():
            if shape not in shapes:
                continue
            start, length = pieces[-1] if pieces else (0, 0)
            if pieces and start + length == first:
                pieces[-1] = start, length + count
            else:
                pieces.append((first, count))
        return pieces


class Geometry:
    """Uploads every shape once. Textures are uploaded when first asked for.

    Args:
        filtering: the knobs of the effect that looks textures up; none: as their samplers say.
    """

    def __init__(self, device: Device, scene: Scene, filtering: Knobs | None = None) -> None:
        filtering = filtering or {}
        self._filter = str(filtering.get("filter", "sampler"))
        self._anisotropy = float(filtering.get("anisotropy", 1.0))
        self._device, self._scene = device, scene
        self._textures: dict[Texture, Any] = {}
        self.batches = [
            self._batch(index, shape.world, shape.material)
            for index, shape in enumerate(scene.shapes)
            if len(shape.mesh.triangles)
        ]

    def _batch(self, index: int, mesh: Mesh, material: Material) -> Batch:
        arrays, indices = vertex_arrays(mesh, tangents=material.uses_tangents, texcoords=bool(material.textures))
        gl = self._device.gl
        buffers = {name: (f"{array.shape[1]}f", gl.buffer(array.tobytes())) for name, array in arrays.items()}
        elements = None if indices is None else gl.buffer(indices.astype(np.uint32).tobytes())
        return Batch(index, material, buffers, elements, mesh.triangles.size)

    @cached_property
    def solid(self) -> Solid:
        """Every opaque shape's positions, uploaded when first asked for."""
        positions, indices, spans = [np.zeros((0, 3), np.float32)], [np.zeros(0, np.uint32)], {}
        vertices = count = 0
        for index, shape in enumerate(self._scene.shapes):
            if shape.material.alpha_mode == "mask" or not len(shape.mesh.triangles):
                continue
            mesh = shape.world
            positions.append(mesh.positions)
            indices.append(mesh.triangles.ravel() + np.uint32(vertices))
            spans[index] = (count, mesh.triangles.size)
            vertices += len(mesh.positions)
            count += mesh.triangles.size
        gl = self._device.gl
        # A buffer cannot be empty: one vertex more is never drawn.
        content = np.concatenate([*positions, np.zeros((1, 3), np.float32)])
        elements = np.concatenate([*indices, np.zeros(1, np.uint32)])
        return Solid(gl.buffer(content.tobytes()), gl.buffer(elements.tobytes()), spans)

    def texture(self, texture: Texture):
        """The texture on the device, with its filters and, where they ask for it, its mipmaps."""
        if texture not in self._textures:
            self._textures[texture] = self._upload(texture)
        return self._textures[texture]

    def _upload(self, texture: Texture):
        texels = rgba(texture.image)
        height, width = texels.shape[:2]
        self._device.counts["textures"] += 1
        gl = self._device.gl
        if texels.dtype == np.uint8:
            internal = GL_SRGB8_ALPHA8 if texture.srgb else None
            out = gl.texture((width, height), 4, texels.tobytes(), internal_format=internal)
        else:
            if texture.srgb:  # there is no sRGB format for floats: decoded here, alpha as it is
                texels = np.concatenate([srgb_decode(texels[..., :3]), texels[..., 3:]], axis=2).astype(np.float32)
            out = gl.texture((width, height), 4, texels.tobytes(), dtype="f4")
        smaller, larger = self._filters(texture)
        if "mipmap" in smaller:
            out.build_mipmaps()
        # Clamped, unless repeated: a mirrored coordinate is folded into 0…1 by the shader, and at the fold a texel's
        # neighbour is itself, as clamping has it.
        out.repeat_x, out.repeat_y = texture.wrap_u == "repeat", texture.wrap_v == "repeat"
        out.filter = (FILTERS[smaller], FILTERS[larger])
        if self._anisotropy > 1:
            out.anisotropy = self._anisotropy
        return out

    def _filters(self, texture: Texture) -> tuple[str, str]:
        """The filters for texels smaller and larger than a pixel: those of the sampler, unless one is set for all."""
        if self._filter == "sampler":
            return texture.min_filter, texture.mag_filter
        return self._filter, self._filter.partition("_")[0]


def rgba(image: Image) -> np.ndarray:
    """(H, W, 4) texels; grey is spread, alpha is 1 where there is none."""
    texels = image.texels
    one = 255 if texels.dtype == np.uint8 else 1
    channels = texels.shape[2]
    color = texels[..., :3] if channels >= 3 else np.repeat(texels[..., :1], 3, axis=2)
    alpha = texels[..., -1:] if channels in (2, 4) else np.full_like(texels[..., :1], one)
    return np.ascontiguousarray(np.concatenate([color, alpha], axis=2))


def vertex_arrays(mesh: Mesh, *, tangents: bool, texcoords: bool) -> tuple[dict[str, np.ndarray], np.ndarray | None]:
    """Attribute arrays (N, C) float32 and indices; a mesh without normals is unrolled and given its faces' normals."""
    arrays = {"position": mesh.positions}
    if mesh.normals is not None:
        arrays["normal"] = mesh.normals
    if texcoords:
        arrays |= {f"texcoord{i}": uv for i, uv in enumerate(mesh.texcoords[:2])}
    if tangents and mesh.tangents is not None:
        arrays["tangent"] = mesh.tangents
    if mesh.colors is not None:
        arrays["color"] = mesh.colors
    if mesh.normals is not None:
        return arrays, mesh.triangles
    corners = mesh.triangles.ravel()
    arrays = {name: array[corners] for name, array in arrays.items()}
    a, b, c = (arrays["position"][i::3].astype(np.float64) for i in range(3))
    faces = np.cross(b - a, c - a)
    lengths = np.linalg.norm(faces, axis=1, keepdims=True)
    faces /= np.where(lengths > 0, lengths, 1)
    arrays["normal"] = np.repeat(faces, 3, axis=0).astype(np.float32)
    return arrays, None
