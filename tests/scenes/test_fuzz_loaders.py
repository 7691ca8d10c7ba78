"""Mutated files of every kind: a loader gives a scene or a SceneError, and nothing else, soon."""

import json
import struct
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Scene

from .synthetic_gltf import QUAD, QUAD_UV, UP, Writer, png

BOUNDED = settings(
    max_examples=250,
    deadline=2000,
    derandomize=True,
    database=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)

CHECKER = png(np.uint8([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 255]]]))

TOML = """
name = "fuzzed"
max_depth = 4
[camera]
position = [0, 1, 5]
target = [0, 0, 0]
yfov = 40
[environment]
radiance = [0.1, 0.2, 0.3]
[materials.grey]
base_color = 0.5
base_color_texture = {file = "checker.png", wrap = "clamp"}
normal_texture = "checker.png"
[[lights]]
type = "spot"
position = [0, 3, 0]
target = [0, 0, 0]
intensity = 5
inner = 10
outer = 20
[[shapes]]
type = "sphere"
segments = 8
material = "grey"
rotate = [10, 20, 30]
scale = [1, -1, 2]
[[shapes]]
type = "mesh"
file = "mesh.obj"
axis = [0, 1, 0]
angle = 30
"""
OBJ = """# a quad
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 1 0
vn 0 0 1
f 1/1/1 2/2/1 3/1/1 4/2/1
f -4 -3 -2
"""
PLY = """ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
property uchar red
property uchar green
property uchar blue
element face 2
property list uchar int vertex_indices
end_header
0 0 0 255 0 0
1 0 0 0 255 0
1 1 0 0 0 255
0 1 0 9 9 9
3 0 1 2
4 0 1 2 3
"""


def binary_ply(order: str) -> bytes:
    name = {"<": "little", ">": "big"}[order]
    head = (
        f"ply\nformat binary_{name}_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
    )
    faces = struct.pack(f"{order}B3iB3i", 3, 0, 1, 2, 3, 0, 2, 3)
    return head.encode() + QUAD.astype(f"{order}f4").tobytes() + faces


def gltf() -> Writer:
    """A file that uses most of what is read."""
    writer = Writer()
    lights = [{"type": "spot", "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5}, "intensity": 3}]
    writer.content["extensions"] = {"KHR_lights_punctual": {"lights": lights}}
    writer.content["cameras"] = [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}]
    info = {
        "index": writer.texture(CHECKER, wrapS=33071),
        "extensions": {"KHR_texture_transform": {"rotation": 1, "scale": [2, 2]}},
    }
    material = {
        "pbrMetallicRoughness": {"baseColorTexture": info, "baseColorFactor": [1, 1, 1, 0.5]},
        "normalTexture": info,
        "emissiveFactor": [1, 1, 0],
        "alphaMode": "MASK",
    }
    sparse = {
        "count": 1,
        "indices": {"bufferView": writer.view(b"\1"), "componentType": 5121},
        "values": {"bufferView": writer.view(np.float32([2, 0, 0]).tobytes())},
    }
    position = writer.accessor(QUAD, sparse=sparse)
    mesh = writer.mesh(material=material, POSITION=position, NORMAL=UP, TEXCOORD_0=QUAD_UV)
    child = writer.node(root=False, mesh=mesh, rotation=[0, 0, 0, 1], scale=[1, 2, 3])
    writer.node(children=[child], matrix=np.eye(4).ravel().tolist())
    writer.node(camera=0, translation=[0, 0, 5])
    writer.node(translation=[0, 3, 0], extensions={"KHR_lights_punctual": {"light": 0}})
    return writer


def outcome(path: Path) -> Scene | SceneError:
    """The scene or the refusal; anything else is a failure. Warnings are failures too."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            return load(path)
        except SceneError as error:
            assert "\n" not in str(error)
            return error


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("fuzz")
    (folder / "checker.png").write_bytes(CHECKER)
    (folder / "mesh.obj").write_text(OBJ)
    return folder


def places(value: Any, path: tuple = ()) -> list[tuple]:
    """The path of every value in nested lists and tables."""
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    return [path] * bool(path) + [place for key, child in items for place in places(child, (*path, key))]


ODD = st.one_of(
    st.sampled_from(
        [None, True, -1, 0, 1, 2, 3, 255, 2**31, 2**63, 10**400, 1e308, -1e30, 1e-300, 0.5, "", "a", "../x", [], {}]
    ),
    st.integers(-5, 300),
    st.floats(allow_nan=False, allow_infinity=False),
    st.text(max_size=5),
    st.lists(st.integers(-2, 9), max_size=16),
)
CONTENT = gltf().finished(inline=True)
PLACES = places(CONTENT)


@BOUNDED
@given(st.lists(st.tuples(st.sampled_from(PLACES), ODD), min_size=1, max_size=3))
def test_gltf_json(folder, changes):
    content = json.loads(json.dumps(CONTENT))
    for place, value in changes:
        parent = content
        try:
            for key in place[:-1]:
                parent = parent[key]
            parent[place[-1]] = value
        except (KeyError, IndexError, TypeError):
            continue  # an earlier change took this place away
    path = folder / "scene.gltf"
    path.write_text(json.dumps(content))
    outcome(path)


def splice(data: bytes, edits: list[tuple[float, int, bytes]]) -> bytes:
    """`data` with pieces cut out and others put in, at fractions of its length."""
    for where, length, new in edits:
        at = int(where * len(data))
        data = data[:at] + new + data[at + length :]
    return data


WORDS = [b"-1", b"1e999", b"nan", b"0", b"99999999999", b"[", b"]", b"{", b"}", b'"', b"\n", b" ", b"\xff", b"\0"]
EDITS = st.lists(
    st.tuples(
        st.floats(0, 1),
        st.integers(0, 12),
        st.one_of(st.sampled_from(WORDS), st.binary(max_size=6)),
    ),
    min_size=1,
    max_size=4,
)


def saved_glb() -> bytes:
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        return gltf().save(Path(folder), "scene.glb").read_bytes()


FILES = {
    "scene.glb": saved_glb(),
    "scene.toml": TOML.encode(),
    "mesh.obj": OBJ.encode(),
    "ascii.ply": PLY.encode(),
    "little.ply": binary_ply("<"),
    "big.ply": binary_ply(">"),
    "checker.png": CHECKER,
}


@pytest.mark.parametrize("name", FILES)
def test_bytes(tmp_path, name):
    """Byte edits anywhere; meshes and images are reached through a scene file."""
    for other, data in FILES.items():
        (tmp_path / other).write_bytes(data)
    entry = tmp_path / name
    if name.endswith((".obj", ".ply")):
        entry = tmp_path / "scene.toml"
        entry.write_text(f'[[shapes]]\ntype = "mesh"\nfile = "{name}"\n')
    elif name.endswith(".png"):
        entry = tmp_path / "scene.toml"
    assert isinstance(outcome(entry), Scene)

    @settings(BOUNDED, max_examples=150)
    @given(EDITS)
    def edit(edits):
        (tmp_path / name).write_bytes(splice(FILES[name], edits))
        outcome(entry)

    edit()


KEYS = [line.partition(" = ")[0] for line in TOML.splitlines() if " = " in line]
VALUES = ["-1", "0", "1e30", "nan", "inf", "true", '"x"', "[]", "[1,2]", "[0,0,0]", "{}", "1979-05-27", "10" * 60]


@BOUNDED
@given(st.sampled_from(KEYS), st.sampled_from(VALUES))
def test_toml_values(folder, key, value):
    lines = [f"{key} = {value}" if line.startswith(f"{key} =") else line for line in TOML.splitlines()]
    path = folder / "scene.toml"
    path.write_text("\n".join(lines))
    outcome(path)
