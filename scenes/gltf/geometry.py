"""Primitives as meshes (glTF 2.0, section 3.7.2)."""

import numpy as np

from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.gltf.accessors import read_floats, read_indices
from lightmeter.scenes.gltf.document import Primitive
from lightmeter.scenes.gltf.source import Source
from lightmeter.scenes.model import Mesh
from lightmeter.scenes.normals import repaired_normals, unit_vectors

NOT_SURFACES = {0: "points", 1: "lines", 2: "a line loop", 3: "a line strip"}
TRIANGLES, STRIP = 4, 5
MOST_TEXCOORDS = 8


def read_primitive(source: Source, primitive: Primitive, place: str) -> Mesh | None:
    """The triangles of a primitive, or None, with a note, where it has no surface.

    Raises:
        SceneError: an accessor is wrong, attributes differ in length, or an index is out of range.
    """
    if primitive.mode in NOT_SURFACES:
        source.note(f"{place} is left out of both pictures: {NOT_SURFACES[primitive.mode]}, not triangles")
        return None
    if "POSITION" not in primitive.attributes:
        source.note(f"{place} is left out of both pictures: it has no positions")
        return None
    if primitive.targets:
        source.note("morph targets are left out: meshes stand in their base shape")
    positions = _attribute(source, primitive, "POSITION", (3,), None, place)
    assert positions is not None
    count = len(positions)
    triangles = _triangles(source, primitive, count, place)
    if not len(triangles):
        source.note(f"{place} is left out: it has no triangle with three different corners")
        return None
    normals = _attribute(source, primitive, "NORMAL", (3,), count, place)
    tangents = None
    if normals is not None:
        normals, lost = repaired_normals(normals, positions, triangles)
        if lost:
            source.note(f"{place}: {lost} normals without length are replaced by their triangles' mean")
        tangents = _attribute(source, primitive, "TANGENT", (4,), count, place)
        tangents = None if tangents is None else _tangents(source, tangents, place)
    return Mesh(
        positions, triangles, normals, _texcoords(source, primitive, count, place), tangents,
        _colors(source, primitive, count, place),
    )  # fmt: skip


def _attribute(
    source: Source, primitive: Primitive, name: str, widths: tuple[int, ...], count: int | None, place: str
) -> np.ndarray | None:
    """One attribute's values, (count, width) float32, or None where the primitive lacks it."""
    index = primitive.attributes.get(name)
    if index is None:
        return None
    here = f"{place}.attributes.{name}"
    values = read_floats(source, index, widths, here)
    if count is not None and len(values) != count:
        raise SceneError(
            f"{name} has another length than POSITION",
            where=source.at(here),
            expected=f"{count} elements",
            actual=f"{len(values)}",
        )
    return values


def _triangles(source: Source, primitive: Primitive, count: int, place: str) -> np.ndarray:
    """(M, 3) int64: the primitive's triangles, without those that name a vertex twice."""
    if primitive.indices is None:
        corners = np.arange(count)
    else:
        corners = read_indices(source, primitive.indices, f"{place}.indices")
        if corners.max() >= count:
            raise SceneError(
                "an index names a vertex that is not there",
                where=source.at(f"{place}.indices, element {int(np.argmax(corners >= count))}"),
                expected=f"0 to {count - 1}",
                actual=f"{int(corners.max())}",
            )
    if primitive.mode == TRIANGLES:
        if len(corners) % 3:
            raise SceneError(
                "the triangles are incomplete",
                where=source.at(place),
                expected="a multiple of 3 corners",
                actual=f"{len(corners)}",
            )
        triangles = corners.reshape(-1, 3)
    elif primitive.mode == STRIP:
        first, odd = np.arange(max(len(corners) - 2, 0)), np.arange(max(len(corners) - 2, 0)) % 2
        triangles = corners[np.stack([first, first + 1 + odd, first + 2 - odd], axis=1)]
    else:  # a fan
        first = np.arange(1, max(len(corners) - 1, 1))
        triangles = corners[np.stack([first, first + 1, np.zeros_like(first)], axis=1)]
    a, b, c = triangles.T
    return triangles[(a != b) & (b != c) & (c != a)]


def _texcoords(source: Source, primitive: Primitive, count: int, place: str) -> tuple[np.ndarray, ...]:
    """The sets 0, 1, … as far as they go."""
    sets: list[np.ndarray] = []
    while len(sets) < MOST_TEXCOORDS:
        values = _attribute(source, primitive, f"TEXCOORD_{len(sets)}", (2,), count, place)
        if values is None:
            break
        sets.append(values)
    return tuple(sets)


def _colors(source: Source, primitive: Primitive, count: int, place: str) -> np.ndarray | None:
    """(count, 4) float32 in 0…1; alpha is 1 where the file gives RGB alone."""
    if "COLOR_1" in primitive.attributes:
        source.note(f"{place}: vertex colours beyond the first set are left out, as glTF says")
    colors = _attribute(source, primitive, "COLOR_0", (3, 4), count, place)
    if colors is None:
        return None
    if colors.shape[1] == 3:
        colors = np.concatenate([colors, np.ones((count, 1), np.float32)], axis=1)
    return np.clip(colors, 0, 1)


def _tangents(source: Source, tangents: np.ndarray, place: str) -> np.ndarray | None:
    """Unit tangents whose w is −1 or 1; None, with a note, where one has no length: they are derived then."""
    length = np.linalg.norm(tangents[:, :3].astype(np.float64), axis=1)
    if (length < 1e-12).any():
        source.note(f"{place}: its tangents are derived anew, since some have no length")
        return None
    return np.concatenate([unit_vectors(tangents[:, :3]), np.where(tangents[:, 3:] < 0, -1, 1)], axis=1)
