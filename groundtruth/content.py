"""Digests: which scene, which points, which definition of the truth. No Mitsuba is needed."""

import hashlib
import struct
from dataclasses import fields, is_dataclass
from functools import cache
from importlib.metadata import version
from pathlib import Path
from weakref import WeakKeyDictionary

import numpy as np

import lightmeter.scenes.optics as optics
from lightmeter.scenes.model import Scene
from lightmeter.scenes.points import SurfacePoints

_WITHOUT_LIGHT = {
    "Scene": {"name", "summary", "notes"},
    "Camera": {"name", "near", "far", "exposure", "metering", "aperture", "view"},
    "Shape": {"name", "form"},
    "Material": {"name", "occlusion_texture", "occlusion_strength", "left_out"},
    "Texture": {"min_filter"},
    "Image": {"name"},
    "PointLight": {"name"},
    "SpotLight": {"name"},
    "DirectionalLight": {"name"},
}
"""Fields that change no light in the truth: names, and what only the real-time side or the display reads."""


_known_scenes: WeakKeyDictionary[Scene, str] = WeakKeyDictionary()


def scene_key(scene: Scene) -> str:
    """64 hex digits that two scenes share when, and only when, the truth is the same (sha256 over their content)."""
    if scene not in _known_scenes:
        _known_scenes[scene] = digest(scene)
    return _known_scenes[scene]


def points_key(points: SurfacePoints) -> str:
    """64 hex digits for the points an oracle is evaluated at (sha256 over all their arrays)."""
    return digest(points)


@cache
def definition_key() -> str:
    """64 hex digits for what the truth is by definition: the sources of the optics and of the ground truth."""
    state = hashlib.sha256()
    for folder in (Path(optics.__file__).parent, Path(__file__).parent):
        for path in sorted(folder.rglob("*.py")):
            text = path.read_bytes().replace(b"\r\n", b"\n")
            state.update(f"{path.relative_to(folder)}\0{len(text)}\0".encode())
            state.update(text)
    return state.hexdigest()


@cache
def versions() -> str:
    """The path tracer's versions, as they are written into batches."""
    return f"mitsuba {version('mitsuba')}, drjit {version('drjit')}"


def digest(value: object) -> str:
    """sha256 over a canonical encoding of numbers, text, arrays, sequences, mappings and dataclasses.

    Raises:
        TypeError: there is something else in it.
    """
    state = hashlib.sha256()
    _feed(state, value, {})
    return state.hexdigest()


def _feed(state, value: object, known: dict[int, bytes]) -> None:
    match value:
        case None:
            state.update(b"N")
        case bool() | np.bool_():
            state.update(b"T" if value else b"F")
        case int() | np.integer():
            text = str(int(value)).encode()
            state.update(b"I" + struct.pack("<Q", len(text)) + text)
        case float() | np.floating():
            state.update(b"D" + struct.pack("<d", float(value)))
        case str():
            text = value.encode()
            state.update(b"S" + struct.pack("<Q", len(text)) + text)
        case np.ndarray():
            state.update(b"A" + _array(value, known))
        case tuple() | list():
            state.update(b"L" + struct.pack("<Q", len(value)))
            for item in value:
                _feed(state, item, known)
        case dict():
            state.update(b"M" + struct.pack("<Q", len(value)))
            for key in sorted(value):
                _feed(state, key, known)
                _feed(state, value[key], known)
        case _ if is_dataclass(value):
            name = type(value).__name__
            left_out = _WITHOUT_LIGHT.get(name, set())
            _feed(state, name, known)
            for field in fields(value):
                if field.name not in left_out:
                    _feed(state, field.name, known)
                    _feed(state, getattr(value, field.name), known)
        case _:
            raise TypeError(f"a {type(value).__name__} has no canonical encoding")


def _array(array: np.ndarray, known: dict[int, bytes]) -> bytes:
    """The digest of an array; one that many shapes share is read once."""
    if id(array) not in known:
        inner = hashlib.sha256(f"{array.dtype.str}{array.shape}".encode())
        inner.update(np.ascontiguousarray(array))
        known[id(array)] = inner.digest()
    return known[id(array)]
