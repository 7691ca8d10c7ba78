"""Stanford PLY: the polygons of a file as one mesh; ASCII and binary."""

import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from lightmeter.scenes.errors import SceneError, shown
from lightmeter.scenes.files import read_bytes
from lightmeter.scenes.model import Mesh
from lightmeter.scenes.normals import repaired_normals
from lightmeter.scenes.polygons import distinct, fans

_TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "ushort": "u2",
    "uint16": "u2", "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4", "float": "f4", "float32": "f4",
    "double": "f8", "float64": "f8",
}  # fmt: skip
_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
_INDICES = ("vertex_indices", "vertex_index")
_TEXCOORDS = (("s", "t"), ("u", "v"), ("texture_u", "texture_v"))
LONGEST_HEADER = 2**16


@dataclass
class _Element:
    """One kind of record; a property is its name, its type, and its length's type where it is a list."""

    name: str
    count: int
    properties: list[tuple[str, str, str | None]] = field(default_factory=list)

    @property
    def is_flat(self) -> bool:
        return all(length is None for _, _, length in self.properties)


def load_ply(path: Path) -> tuple[Mesh, tuple[str, ...]]:
    """All the polygons of a PLY file, as fans of triangles, and notes on what was left out.

    Read per vertex: x y z, nx ny nz, s t (or u v; turned from an origin at the bottom to the top), red green
    blue alpha (bytes are taken for sRGB, fractions for linear).

    Raises:
        SceneError: the file is missing, damaged or truncated, or an index is out of range.
    """
    where = str(path)
    data = read_bytes(path)
    order, elements, body = _header(data, where)
    vertices: dict[str, np.ndarray] = {}
    as_bytes = False
    sizes, corners = np.zeros(0, np.int64), np.zeros(0, np.int64)
    notes: list[str] = []
    reader = _Ascii(data[body:], where) if not order else _Binary(data, body, order, where)
    wanted = {"vertex", "face"}
    for element in elements:
        if element.name == "vertex":
            vertices = reader.flat(element)
            as_bytes = ("red", "u1", None) in element.properties
        elif element.name == "face":
            sizes, corners = reader.faces(element)
        elif element.is_flat:
            reader.flat(element)
            notes.append(f"the element {element.name[:40]!r} is left out")
        else:
            raise SceneError(f"the element {element.name[:40]!r} holds lists and is not supported", where=where)
        wanted.discard(element.name)
        if not wanted:
            break
    return _mesh(vertices, as_bytes, sizes, corners, notes, where), tuple(notes)


def _header(data: bytes, where: str) -> tuple[str, list[_Element], int]:
    """Byte order ("" for ASCII), elements, and where the body starts."""
    end = re.search(rb"\nend_header[ \t]*\r?\n", data[:LONGEST_HEADER])
    if not data.startswith(b"ply") or end is None:
        raise SceneError("this is no PLY, or its header is cut off", where=where, actual=shown(data[:16]))
    order, elements = None, []
    for number, line in enumerate(data[: end.start()].decode("latin-1").splitlines(), 1):
        words = line.split()
        try:
            match words:
                case [] | ["ply"] | ["comment" | "obj_info", *_]:
                    pass
                case ["format", name, _]:
                    order = _ORDERS[name]
                case ["element", name, count]:
                    elements.append(_Element(name, int(count)))
                    if elements[-1].count < 0:
                        raise ValueError
                case ["property", "list", length, kind, name]:
                    if _TYPES[length][0] == "f":
                        raise ValueError
                    elements[-1].properties.append((name, _TYPES[kind], _TYPES[length]))
                case ["property", kind, name]:
                    elements[-1].properties.append((name, _TYPES[kind], None))
                case _:
                    raise ValueError
        except (ValueError, KeyError, IndexError):
            raise SceneError(
                "this header line cannot be read", where=f"{where}: line {number}", actual=shown(line)
            ) from None
    if order is None:
        raise SceneError("the header names no format", where=where, expected="a line that begins with format")
    for element in elements:
        names = [name for name, _, _ in element.properties]
        if len(set(names)) < len(names) or (element.count and not names):
            raise SceneError(f"the properties of {element.name[:40]!r} are missing or named twice", where=where)
    return order, elements, end.end()


class _Ascii:
    """Reads records from words."""

    def __init__(self, body: bytes, where: str):
        self._words, self._at, self._where = body.split(), 0, where

    def flat(self, element: _Element) -> dict[str, np.ndarray]:
        width = len(element.properties)
        table = self._numbers(element.count * width, element.name).reshape(-1, width)
        return {name: table[:, i] for i, (name, _, _) in enumerate(element.properties)}

    def faces(self, element: _Element) -> tuple[np.ndarray, np.ndarray]:
        sizes, corners = [], []
        _check_face_count(element, len(self._words) - self._at, self._where)
        for _ in range(element.count):
            for name, _, length in element.properties:
                count = 1 if length is None else int(self._numbers(1, "face")[0])
                values = self._numbers(count, "face")
                if name in _INDICES:
                    sizes.append(count)
                    corners.append(values)
        return np.array(sizes, np.int64), _indices(np.concatenate(corners or [np.zeros(0)]))

    def _numbers(self, count: int, what: str) -> np.ndarray:
        words = self._words[self._at : self._at + count] if count >= 0 else []
        if len(words) != count:
            raise SceneError(
                f"the file is truncated in {what[:40]!r}",
                where=self._where,
                expected=f"{count} numbers",
                actual=f"{len(words)}",
            )
        self._at += count
        try:
            if max(map(len, words), default=0) > 64:
                raise ValueError("a word of more than 64 characters")
            values = np.array([float(word) for word in words])
        except ValueError as error:
            raise SceneError(f"no number in {what[:40]!r} ({str(error)[:80]})", where=self._where) from None
        if not np.isfinite(values).all():
            raise SceneError(
                f"{what[:40]!r} holds a number that is not finite",
                where=self._where,
                expected="finite numbers",
            )
        return values


class _Binary:
    """Reads records from bytes."""

    def __init__(self, data: bytes, at: int, order: str, where: str):
        self._data, self._at, self._order, self._where = data, at, order, where

    def flat(self, element: _Element) -> dict[str, np.ndarray]:
        if not element.is_flat:
            raise SceneError(
                f"the element {element.name[:40]!r} holds lists, which is not supported", where=self._where
            )
        dtype = np.dtype([(name, self._order + kind) for name, kind, _ in element.properties])
        table = self._take(dtype, element.count, element.name)
        with np.errstate(invalid="ignore"):  # signalling NaNs; what is not finite is refused later
            return {name: table[name].astype(np.float64) for name, _, _ in element.properties}

    def faces(self, element: _Element) -> tuple[np.ndarray, np.ndarray]:
        _check_face_count(element, len(self._data) - self._at, self._where)
        return self._equal_faces(element) or self._any_faces(element)

    def _equal_faces(self, element: _Element) -> tuple[np.ndarray, np.ndarray] | None:
        """The faces, if there is one list a face and all are as long as the first."""
        lists = [index for index, (_, _, length) in enumerate(element.properties) if length is not None]
        if len(lists) != 1 or element.properties[lists[0]][0] not in _INDICES or not element.count:
            return None
        fields = [(f"other {i}", self._order + kind) for i, (_, kind, _) in enumerate(element.properties)]
        ahead, behind = fields[: lists[0]], fields[lists[0] + 1 :]
        _, kind, length = element.properties[lists[0]]
        start = self._at
        head = np.dtype([*ahead, ("count", f"{self._order}{length}")])
        size = int(self._take(head, 1, "face")["count"][0])
        self._at = start
        if not 3 <= size <= 255:
            return None
        dtype = np.dtype([*head.descr, ("corners", self._order + kind, (size,)), *behind])
        if start + dtype.itemsize * element.count > len(self._data):
            return None
        table = self._take(dtype, element.count, "face")
        if not (table["count"] == size).all():
            self._at = start
            return None
        return np.full(element.count, size, np.int64), table["corners"].astype(np.int64).ravel()

    def _any_faces(self, element: _Element) -> tuple[np.ndarray, np.ndarray]:
        sizes, corners = [], [np.zeros(0, np.int64)]
        for _ in range(element.count):
            for name, kind, length in element.properties:
                count = 1
                if length is not None:
                    count = int(self._take(np.dtype(self._order + length), 1, "face")[0])
                values = self._take(np.dtype(self._order + kind), count, "face")
                if name in _INDICES:
                    sizes.append(count)
                    corners.append(values.astype(np.int64))
        return np.array(sizes, np.int64), np.concatenate(corners)

    def _take(self, dtype: np.dtype, count: int, what: str) -> np.ndarray:
        size = dtype.itemsize * count
        if count < 0 or self._at + size > len(self._data):
            raise SceneError(
                f"the file is truncated in {what[:40]!r}",
                where=f"{self._where}: byte {self._at}",
                expected=f"{size} bytes",
                actual=f"{len(self._data) - self._at}",
            )
        values = np.frombuffer(self._data, dtype, count, self._at)
        self._at += size
        return values


def _indices(values: np.ndarray) -> np.ndarray:
    """Whole numbers as int64; what is none, or beyond any vertex, becomes −1."""
    fitting = (values >= 0) & (values < 2**40) & (values == np.floor(values))
    return np.where(fitting, values, -1).astype(np.int64)


def _check_face_count(element: _Element, left: int, where: str) -> None:
    if element.count > left:
        raise SceneError(
            "the file has fewer faces than it says",
            where=where,
            expected=f"{element.count}",
            actual=f"at most {left}",
        )


def _mesh(
    vertices: dict[str, np.ndarray],
    as_bytes: bool,
    sizes: np.ndarray,
    corners: np.ndarray,
    notes: list[str],
    where: str,
) -> Mesh:
    positions = _columns(vertices, ("x", "y", "z"), where)
    if positions is None or not len(sizes):
        raise SceneError("the file has no vertices with x, y, z, or no faces", where=where)
    count = len(positions)
    if sizes.min() < 3:
        notes.append(f"{int((sizes < 3).sum())} faces of fewer than three corners are left out")
        corners, sizes = corners[np.repeat(sizes >= 3, sizes)], sizes[sizes >= 3]
    if not len(corners):
        raise SceneError("the file has no faces of three corners or more", where=where)
    if corners.min() < 0 or corners.max() >= count:
        bad = int(corners[(corners < 0) | (corners >= count)][0])
        raise SceneError(
            "a face names a vertex that is not there",
            where=where,
            expected=f"0 to {count - 1}",
            actual=f"{bad}",
        )
    triangles = distinct(corners[fans(sizes)])
    normals = _columns(vertices, ("nx", "ny", "nz"), where)
    if normals is not None:
        normals, lost = repaired_normals(normals, positions, triangles)
        if lost:
            notes.append(f"{lost} normals without length are replaced by their triangles' mean")
    found = (_columns(vertices, names, where) for names in _TEXCOORDS)
    texcoords = tuple(uv * (1, -1) + (0, 1) for uv in found if uv is not None)[:1]
    return Mesh(positions, triangles, normals, texcoords, colors=_colors(vertices, as_bytes, where))


def _columns(vertices: dict[str, np.ndarray], names: tuple[str, ...], where: str) -> np.ndarray | None:
    """(N, len(names)) float32, or None where one is missing."""
    if any(name not in vertices for name in names):
        return None
    with np.errstate(over="ignore"):
        out = np.stack([vertices[name] for name in names], axis=1).astype(np.float32)
    if not np.isfinite(out).all():
        bad = int(np.argmin(np.isfinite(out).all(axis=1)))
        raise SceneError(f"{' '.join(names)} of vertex {bad} is not finite", where=where, actual=str(out[bad].tolist()))
    return out


def _colors(vertices: dict[str, np.ndarray], as_bytes: bool, where: str) -> np.ndarray | None:
    """(N, 4) float32 linear, or None; bytes are decoded from sRGB (IEC 61966-2-1)."""
    colors = _columns(vertices, ("red", "green", "blue"), where)
    if colors is None:
        return None
    alpha = _columns(vertices, ("alpha",), where)
    if alpha is None:
        alpha = np.full((len(colors), 1), 255 if as_bytes else 1, np.float32)
    if as_bytes:
        colors, alpha = np.clip(colors / 255, 0, 1), alpha / 255
        colors = np.where(colors <= 0.04045, colors / 12.92, ((colors + 0.055) / 1.055) ** 2.4)
    return np.clip(np.concatenate([colors, alpha], axis=1), 0, 1)
