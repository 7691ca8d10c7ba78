"""Everything about a scene's surfaces that Mitsuba's meshes do not hold, as flat Dr.Jit tables.

Mitsuba gets the triangles, our optics get everything else. A triangle's corner `c` of a shape is row
`3·(first_triangle + triangle) + c` of the corner tables. A table that a shape does not need has one row for it,
reached with stride 0, so that every shape is read the same way.
"""

from dataclasses import dataclass

import numpy as np

from lightmeter.groundtruth.variant import dr, mi
from lightmeter.scenes.model import Mesh, Scene, Shape, Texture
from lightmeter.scenes.optics import sheen
from lightmeter.scenes.optics.texture import TexelGrid, linear_texels

SLOTS = (
    "base_color",
    "metallic_roughness",
    "normal",
    "occlusion",
    "emissive",
    "clearcoat",
    "clearcoat_roughness",
    "clearcoat_normal",
    "anisotropy",
    "sheen_color",
    "sheen_roughness",
)

_NEUTRAL = {slot: np.ones((1, 1, 4), np.float32) for slot in SLOTS} | {
    slot: np.array([[[0.5, 0.5, 1, 1]]], np.float32) for slot in ("normal", "clearcoat_normal")
}
_NEUTRAL["anisotropy"] = np.array([[[1, 0.5, 1, 1]]], np.float32)

DOUBLE_SIDED, MASKED = 1, 2


@dataclass(frozen=True, eq=False)
class Tables:
    """Flat arrays in Dr.Jit; rows are gathered by shape, by shape × slot, or by corner.

    Attributes:
        shape_ints: 8 per shape: first triangle, flags, first tangent, its stride, first colour, its stride, 0, 0.
        shape_floats: 16 per shape: base colour and alpha; metallic, roughness, specular, normal scale; emissive and
            alpha cut-off; occlusion strength, clear coat, its roughness and normal scale.
        grain_floats: 4 per shape: strength of the anisotropy, the grain's direction along tangent and bitangent, 0.
        sheen_floats: 4 per shape: colour and roughness of the sheen.
        sheen_albedo: the sheen's table of albedos, flat; one element where no material has a sheen.
        slot_ints: 8 per shape × slot: first texel, first texture coordinate, its stride, width, height, wrap u,
            wrap v, nearest.
        slot_floats: 8 per shape × slot: the texture's 2 × 3 matrix, 0, 0.
        positions: 3 per corner, world space.
        normals: 3 per corner, world space; the face's where the shape is flat.
        tangents: 4 per corner of the shapes that have them.
        colors: 4 per corner of the shapes that have them.
        texcoords: 2 per corner, one set after the other.
        texels: 4 per texel, linear RGBA.
        shape_of: index of the shape, by Mitsuba's registry id.
    """

    shape_ints: object
    shape_floats: object
    grain_floats: object
    sheen_floats: object
    sheen_albedo: object
    slot_ints: object
    slot_floats: object
    positions: object
    normals: object
    tangents: object
    colors: object
    texcoords: object
    texels: object
    shape_of: object


def face_normals(mesh: Mesh) -> np.ndarray:
    """(M, 3) float64 unit normals of the triangles, on the front; zero where a triangle has no area."""
    p = mesh.positions.astype(np.float64)[mesh.triangles]
    n = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    length = np.linalg.norm(n, axis=1, keepdims=True)
    return n / np.where(length > 0, length, 1)


class _Rows:
    """Rows of float32 gathered from shapes, remembered by what they were made from."""

    def __init__(self, width: int):
        self.width, self.count, self.parts, self.known = width, 0, [], {}

    def add(self, key: object, make) -> int:
        """First row of what `make` returns, which is stored once per `key`."""
        if key not in self.known:
            rows = np.asarray(make(), np.float32).reshape(-1, self.width)
            self.known[key] = self.count
            self.parts.append(rows)
            self.count += len(rows)
        return self.known[key]

    def array(self):
        return mi.Float(np.concatenate(self.parts).ravel())


def build(scene: Scene, registry_ids: list[int | None]) -> Tables:
    """The tables of a scene.

    Args:
        registry_ids: Mitsuba's id of each shape's mesh; None where it has none.

    Raises:
        ValueError: the scene has more texels or corners than 32 bits can count, or a mesh lacks what its material
            looks up.
    """
    corners, normals = _Rows(3), _Rows(3)
    tangents, colors, texcoords, texels = _Rows(4), _Rows(4), _Rows(2), _Rows(4)
    no_tangent = tangents.add("none", lambda: [1, 0, 0, 1])
    no_color = colors.add("none", lambda: [1, 1, 1, 1])
    no_texcoord = texcoords.add("none", lambda: [0, 0])
    shape_ints, shape_floats, slot_ints, slot_floats = [], [], [], []
    grain_floats, sheen_floats = [], []
    first_triangle = 0
    keep = []  # so that no id() is given out twice while the tables are built
    for index, shape in enumerate(scene.shapes):
        mesh, material = shape.world, shape.material
        _check(shape)
        flat_index = mesh.triangles.ravel()
        keep.append(mesh)
        corners.add(index, lambda mesh=mesh, i=flat_index: mesh.positions[i])
        normals.add(index, lambda mesh=mesh, i=flat_index: _corner_normals(mesh, i))
        tangent, tangent_stride = no_tangent, 0
        if mesh.tangents is not None and material.uses_tangents:
            tangent = tangents.add(index, lambda mesh=mesh, i=flat_index: mesh.tangents[i])
            tangent_stride = 1
        color, color_stride = no_color, 0
        if mesh.colors is not None:
            color, color_stride = colors.add(index, lambda mesh=mesh, i=flat_index: mesh.colors[i]), 1
        flags = DOUBLE_SIDED * material.double_sided + MASKED * (material.alpha_mode == "mask")
        shape_ints.append([first_triangle, flags, tangent, tangent_stride, color, color_stride, 0, 0])
        shape_floats.append(_parameters(shape))
        turn = material.anisotropy_rotation
        grain_floats.append([material.anisotropy, np.cos(turn), np.sin(turn), 0.0])
        sheen_floats.append([*material.sheen_color, material.sheen_roughness])
        first_triangle += len(mesh.triangles)
        for slot in SLOTS:
            texture = material.textures.get(slot)
            first_texel = texels.add(*_texel_source(slot, texture))
            texcoord, stride = no_texcoord, 0
            if texture is not None:
                uv = mesh.texcoords[texture.texcoord]
                texcoord = texcoords.add((index, texture.texcoord), lambda uv=uv, i=flat_index: uv[i])
                stride = 1
            ints, floats = _grid(texture)
            slot_ints.append([first_texel, texcoord, stride, *ints])
            slot_floats.append(floats)
    for what, rows in (("corners", corners), ("texels", texels)):
        if rows.count * rows.width >= 2**32:
            raise ValueError(f"the scene has {rows.count} {what}, expected below {2**32 // rows.width}")
    if not scene.shapes:
        corners.add("none", lambda: np.zeros((3, 3)))
        normals.add("none", lambda: np.zeros((3, 3)))
        shape_ints, shape_floats = [[0] * 8], [[0.0] * 16]
        grain_floats, sheen_floats = [[0.0] * 4], [[0.0] * 4]
        slot_ints, slot_floats = [[0] * 8] * len(SLOTS), [[0.0] * 8] * len(SLOTS)
        texels.add("none", lambda: [1, 1, 1, 1])
    numbers = {number: index for index, number in enumerate(registry_ids) if number is not None}
    shape_of = np.zeros(max(numbers, default=0) + 1, np.uint32)
    shape_of[list(numbers)] = list(numbers.values())
    tables = Tables(
        mi.UInt32(np.array(shape_ints, np.uint32).ravel()),
        mi.Float(np.array(shape_floats, np.float32).ravel()),
        mi.Float(np.array(grain_floats, np.float32).ravel()),
        mi.Float(np.array(sheen_floats, np.float32).ravel()),
        mi.Float(_sheen_albedo(scene)),
        mi.UInt32(np.array(slot_ints, np.uint32).ravel()),
        mi.Float(np.array(slot_floats, np.float32).ravel()),
        corners.array(),
        normals.array(),
        tangents.array(),
        colors.array(),
        texcoords.array(),
        texels.array(),
        mi.UInt32(shape_of),
    )
    # Arrays of one element would be literals, baked into kernels.
    dr.make_opaque(*vars(tables).values())
    return tables


def _sheen_albedo(scene: Scene) -> np.ndarray:
    if not any("sheen" in shape.material.layers for shape in scene.shapes):
        return np.zeros(1, np.float32)
    return sheen.albedo_table().astype(np.float32).ravel()


def _check(shape: Shape) -> None:
    """The scene loaders see to this (`scenes/dressing.py`); a scene made by hand may lack it."""
    sets = len(shape.mesh.texcoords)
    for slot, texture in shape.material.textures.items():
        if texture.texcoord >= sets:
            raise ValueError(
                f"shape {shape.name!r}: its {slot} texture needs texture coordinates {texture.texcoord}, "
                f"the mesh has {sets} sets"
            )
    if shape.material.uses_tangents and (shape.mesh.tangents is None or shape.mesh.normals is None):
        what = "a normal texture" if shape.material.has_normal_map else "anisotropy"
        raise ValueError(
            f"shape {shape.name!r}: {what} needs a mesh with normals and tangents "
            "(lightmeter.scenes.dressing.dressed adds them)"
        )


def _corner_normals(mesh: Mesh, flat_index: np.ndarray) -> np.ndarray:
    faces = np.repeat(face_normals(mesh), 3, axis=0)
    if mesh.normals is None:
        return faces
    normals = mesh.normals[flat_index]
    return np.where(np.any(normals != 0, axis=1, keepdims=True), normals, faces)


def _parameters(shape: Shape) -> list[float]:
    m = shape.material
    return [
        *m.base_color,
        m.alpha,
        m.metallic,
        m.roughness,
        m.specular,
        m.normal_scale,
        *m.emissive,
        m.alpha_cutoff,
        m.occlusion_strength,
        m.clearcoat,
        m.clearcoat_roughness,
        m.clearcoat_normal_scale,
    ]


def _texel_source(slot: str, texture: Texture | None):
    """What a slot's texels are remembered by, and how they are made."""
    if texture is None:
        return slot, lambda: _NEUTRAL[slot]
    return (id(texture.image), texture.srgb), lambda: linear_texels(texture)


def _grid(texture: Texture | None) -> tuple[list[int], list[float]]:
    if texture is None:
        return [1, 1, 0, 0, 1], [0.0] * 8
    g = TexelGrid.of(texture)
    return [int(g.width), int(g.height), g.wrap_u, g.wrap_v, g.nearest], [*g.matrix, 0.0, 0.0]
