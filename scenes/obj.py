"""Wavefront OBJ: the polygons of a file as one mesh."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from lightmeter.scenes.errors import SceneError, shown
from lightmeter.scenes.files import read_bytes
from lightmeter.scenes.model import Mesh
from lightmeter.scenes.normals import repaired_normals
from lightmeter.scenes.polygons import distinct, fans

LARGEST = 2**29
"""Bytes of an OBJ file."""

_WIDTHS = {"v": 3, "vt": 2, "vn": 3}
_IGNORED = {"g", "o", "s", "mg", "usemtl", "mtllib"}


def load_obj(path: Path) -> tuple[Mesh, tuple[str, ...]]:
    """All the polygons of an OBJ file, as fans of triangles, and notes on what was left out.

    Texture coordinates are turned from OBJ's origin at the bottom to the top. Without a normal at every corner
    the mesh is flat; smoothing groups are not used. Materials are not read.

    Raises:
        SceneError: the file is missing or damaged, or an index is out of range.
    """
    where = str(path)
    text = read_bytes(path, LARGEST).decode("utf-8", errors="replace")
    columns, corners, sizes, notes = _parse(text, where)
    if not sizes:
        raise SceneError("the file has no faces", where=where)
    indices = np.array(corners, dtype=np.int64)
    rows, same = np.unique(indices, axis=0, return_inverse=True)
    triangles = distinct(same.reshape(-1)[fans(np.array(sizes))])
    used = {kind: values[rows[:, i]] for i, (kind, values) in enumerate(columns.items())}
    positions, normals, texcoords = used["v"], None, ()
    if (rows[:, 2] >= 0).all():
        normals, lost = repaired_normals(used["vn"], positions, triangles)
        if lost:
            notes.append(f"{lost} normals without length are replaced by their triangles' mean")
    elif (rows[:, 2] >= 0).any():
        notes.append("some corners have no normal: the mesh is flat")
    if (rows[:, 1] >= 0).all():
        texcoords = (used["vt"] * (1, -1) + (0, 1),)
    elif (rows[:, 1] >= 0).any():
        notes.append("some corners have no texture coordinates: they are left out")
    return Mesh(positions, triangles, normals, texcoords), tuple(notes)


def _parse(text: str, where: str):
    """The columns v, vt, vn ((N, width) float32 each), corners (three indices each, −1: none), sizes, notes."""
    values: dict[str, list[list[float]]] = {"v": [], "vt": [], "vn": []}
    corners: list[tuple[int, int, int]] = []
    sizes: list[int] = []
    left_out: set[str] = set()
    for number, words in _lines(text):
        key = words[0]
        try:
            if key in _WIDTHS:
                row = [float(word) for word in words[1 : 1 + _WIDTHS[key]]]
                if len(row) < _WIDTHS[key]:
                    row += [0.0] if key == "vt" and len(row) == 1 else _fail("too few numbers")
                values[key].append(row)
            elif key == "f":
                if len(words) < 4:
                    _fail("a face has at least three corners")
                counts = (len(values["v"]), len(values["vt"]), len(values["vn"]))
                corners += [_corner(word, counts) for word in words[1:]]
                sizes.append(len(words) - 1)
            elif key not in _IGNORED:
                left_out.add(key)
        except ValueError as error:
            raise SceneError(
                f"this line cannot be read ({error})",
                where=f"{where}: line {number}",
                actual=shown(" ".join(words)),
            ) from None
    columns = {}
    for key, rows in values.items():
        with np.errstate(over="ignore"):
            columns[key] = np.array(rows, dtype=np.float32).reshape(-1, _WIDTHS[key])
        if not np.isfinite(columns[key]).all():
            bad = int(np.argmin(np.isfinite(columns[key]).all(axis=1)))
            raise SceneError(
                f"number {bad + 1} of the {key!r} lines is not finite",
                where=where,
                expected="finite numbers",
                actual=str(rows[bad]),
            )
        if not len(columns[key]):
            columns[key] = np.zeros((1, _WIDTHS[key]), np.float32)
    notes = ["materials of the file are not read"] if "usemtl" in text else []
    if left_out:
        notes.append("lines of these kinds are left out: " + ", ".join(sorted(left_out)[:10])[:100])
    return columns, corners, sizes, notes


def _lines(text: str) -> Iterator[tuple[int, list[str]]]:
    """Number and words of every line that says something; a backslash at the end continues a line."""
    kept: list[str] = []
    for number, line in enumerate(text.splitlines(), 1):
        line = line.partition("#")[0]
        if line.rstrip().endswith("\\"):
            kept += line.rstrip()[:-1].split()
            continue
        words = kept + line.split()
        kept = []
        if words:
            yield number, words


def _corner(word: str, counts: tuple[int, int, int]) -> tuple[int, int, int]:
    """The position, texture coordinate and normal of a corner, from 0; −1 where it has none."""
    parts = word.split("/")
    if len(parts) > 3:
        _fail("a corner is v, v/vt, v//vn or v/vt/vn")
    out = [-1, -1, -1]
    for slot, part in enumerate(parts):
        if not part and slot:
            continue
        index = int(part)
        out[slot] = index - 1 if index > 0 else counts[slot] + index
        if index == 0 or not 0 <= out[slot] < counts[slot]:
            _fail(f"index {part[:20]} is out of range, {counts[slot]} are there")
    return out[0], out[1], out[2]


def _fail(why: str):
    raise ValueError(why)
