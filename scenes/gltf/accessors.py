"""Typed arrays out of buffers (glTF 2.0, section 3.6): interleaved, normalised, sparse."""

import numpy as np

from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.gltf.document import Sparse
from lightmeter.scenes.gltf.source import Source

DTYPES = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}

MOST_ELEMENTS = 30_000_000
"""Elements of one accessor; one without a buffer could claim any number."""


def read_floats(source: Source, index: int, widths: tuple[int, ...], place: str) -> np.ndarray:
    """An accessor's values, (count, width) float32, integers mapped to 0…1 or −1…1 where it says so.

    Args:
        source: the file.
        index: of the accessor.
        widths: the components per element that are allowed.
        place: what refers to it, for messages.

    Raises:
        SceneError: it is missing, of another width, reaches beyond its bytes, or holds NaN or infinity.
    """
    accessor = source.get("accessors", source.document.accessors, index, place)
    values = _read(source, index, widths, place)
    if accessor.normalized and accessor.component_type in (5121, 5123):
        out = values.astype(np.float32) / np.iinfo(values.dtype).max
    elif accessor.normalized and accessor.component_type in (5120, 5122):
        out = np.maximum(values.astype(np.float32) / np.iinfo(values.dtype).max, -1)
    else:
        out = values.astype(np.float32)
    finite = np.isfinite(out).all(axis=1)
    if not finite.all():
        bad = int(np.argmin(finite))
        raise SceneError(
            "the accessor holds a value that is not finite",
            where=source.at(f"accessors[{index}], element {bad}"),
            expected="finite numbers",
            actual=str(out[bad].tolist()),
        )
    return out


def read_indices(source: Source, index: int, place: str) -> np.ndarray:
    """An accessor of unsigned integers, (count,) int64.

    Raises:
        SceneError: it is missing, of another type, or reaches beyond its bytes.
    """
    accessor = source.get("accessors", source.document.accessors, index, place)
    if accessor.component_type not in (5121, 5123, 5125):
        raise SceneError(
            "indices of this component type are not allowed",
            where=source.at(f"accessors[{index}].componentType"),
            expected="5121, 5123 or 5125 (unsigned integers)",
            actual=f"{accessor.component_type}",
        )
    return _read(source, index, (1,), place)[:, 0].astype(np.int64)


def _read(source: Source, index: int, widths: tuple[int, ...], place: str) -> np.ndarray:
    """(count, width), as stored."""
    accessor = source.get("accessors", source.document.accessors, index, place)
    here = f"accessors[{index}]"
    width = WIDTHS.get(accessor.type, 0)
    if width not in widths:
        names = [name for name, n in WIDTHS.items() if n in widths]
        raise SceneError(
            "the accessor has the wrong type",
            where=source.at(f"{here}.type"),
            expected=" or ".join(names),
            actual=accessor.type,
            remedy=f"it is used by {place}",
        )
    if accessor.count > MOST_ELEMENTS:
        raise SceneError(
            "the accessor is too large",
            where=source.at(f"{here}.count"),
            expected=f"at most {MOST_ELEMENTS}",
            actual=f"{accessor.count}",
        )
    dtype = np.dtype(DTYPES[accessor.component_type])
    if accessor.buffer_view is not None:
        values = _window(source, accessor.buffer_view, accessor.byte_offset, accessor.count, width, dtype, here)
    elif accessor.sparse is not None:
        values = np.zeros((accessor.count, width), dtype)
    else:
        raise SceneError(
            "the accessor has neither a buffer view nor sparse values",
            where=source.at(here),
            remedy="its values would all be zero",
        )
    return values if accessor.sparse is None else _replaced(source, values, accessor.sparse, f"{here}.sparse")


def _replaced(source: Source, values: np.ndarray, sparse: Sparse, place: str) -> np.ndarray:
    """`values` with the sparse ones put in."""
    count, width = sparse.count, values.shape[1]
    if count > len(values):
        raise SceneError(
            "there are more sparse values than values",
            where=source.at(f"{place}.count"),
            expected=f"at most {len(values)}",
            actual=f"{count}",
        )
    indices = _window(
        source,
        sparse.indices.buffer_view,
        sparse.indices.byte_offset,
        count,
        1,
        np.dtype(DTYPES[sparse.indices.component_type]),
        f"{place}.indices",
    )[:, 0].astype(np.int64)
    if indices.max() >= len(values) or (np.diff(indices) <= 0).any():
        raise SceneError(
            "the sparse indices are wrong",
            where=source.at(f"{place}.indices"),
            expected=f"increasing, below {len(values)}",
            actual=f"a largest of {int(indices.max())}",
        )
    out = values.copy()
    out[indices] = _window(
        source,
        sparse.values.buffer_view,
        sparse.values.byte_offset,
        count,
        width,
        values.dtype,
        f"{place}.values",
    )
    return out


def _window(source: Source, view: int, offset: int, count: int, width: int, dtype: np.dtype, place: str) -> np.ndarray:
    """(count, width) of `dtype`, without a copy: elements of a buffer view, one stride apart."""
    data, stride = source.view(view, f"{place}.bufferView")
    size = width * dtype.itemsize
    stride = stride or size
    if stride < size:
        raise SceneError(
            "the view's stride is smaller than an element",
            where=source.at(f"bufferViews[{view}].byteStride"),
            expected=f"at least {size} bytes, for {place}",
            actual=f"{stride}",
        )
    end = offset + (count - 1) * stride + size
    if end > len(data):
        raise SceneError(
            "the accessor reaches beyond its buffer view",
            where=source.at(place),
            expected=f"{end} bytes in bufferViews[{view}]",
            actual=f"{len(data)}",
        )
    return np.ndarray((count, width), dtype, data, offset, (stride, dtype.itemsize))
