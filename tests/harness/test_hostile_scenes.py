"""Scene files that are damaged or lie, given to `compare`: one message that names file and fault, and no work."""

import json
import struct

import pytest

PLANE = """
[camera]
position = [0, 1, 2]
target = [0, 0, 0]
yfov = 40
[[shapes]]
type = "plane"
"""


def gltf(**changes) -> str:
    """A glTF document with one triangle, whose buffer lies inside, and `changes` at its top."""
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64," + "AAAA" * 12}],
    }
    return json.dumps(document | changes)


GLB_HEAD = struct.pack("<4sII", b"glTF", 2, 1000)

SCENES = {
    "empty.toml": ("", "no triangles"),
    "no.toml": ("[[", "TOML"),
    "bytes.toml": (b"\xff\xfe\x00", "TOML"),
    "deep.toml": ("a = " + "[" * 100000, "TOML"),
    "unknown.toml": (PLANE + "colour = 1\n", "'colour'"),
    "type.toml": (PLANE.replace("yfov = 40", 'yfov = "wide"'), "yfov"),
    "range.toml": (PLANE.replace("yfov = 40", "yfov = 400"), "yfov"),
    "nan.toml": (PLANE.replace("[0, 1, 2]", "[0, nan, 2]"), "position"),
    "shape.toml": (PLANE.replace('"plane"', '"plnae"'), "plane"),
    "missing.toml": (PLANE + '[[shapes]]\ntype = "mesh"\nfile = "not-there.ply"\n', "not-there.ply"),
    "climbs.toml": (PLANE + '[[shapes]]\ntype = "mesh"\nfile = "../../secret.ply"\n', "secret.ply"),
    "empty.gltf": ("", "empty.gltf"),
    "no.gltf": ("{", "no.gltf"),
    "list.gltf": ("[]", "list.gltf"),
    "index.gltf": (gltf(nodes=[{"mesh": 7}]), "7"),
    "climbs.gltf": (gltf(buffers=[{"byteLength": 36, "uri": "../../etc/passwd"}]), "passwd"),
    "away.gltf": (gltf(buffers=[{"byteLength": 36, "uri": "https://example.org/a.bin"}]), "fetched"),
    "gone.gltf": (gltf(buffers=[{"byteLength": 36, "uri": "gone.bin"}]), "gone.bin"),
    "huge.gltf": (gltf(accessors=[{"bufferView": 0, "componentType": 5126, "count": 2**31, "type": "VEC3"}]), "count"),
    "loop.gltf": (gltf(nodes=[{"mesh": 0, "children": [1]}, {"children": [0]}]), "node"),
    "version.gltf": (gltf(asset={"version": "1.0"}), "version"),
    "needs.gltf": (gltf(extensionsRequired=["EXT_made_up"], extensionsUsed=["EXT_made_up"]), "EXT_made_up"),
    "cut.glb": (GLB_HEAD, "cut.glb"),
    "lies.glb": (GLB_HEAD + struct.pack("<I4s", 2**32 - 1, b"JSON") + b"{}", "lies.glb"),
    "other.glb": (b"\x89PNG\r\n\x1a\n" + b"\0" * 40, "other.glb"),
}


@pytest.mark.parametrize("name", SCENES)
def test_a_hostile_scene_is_refused_with_its_fault(refused, tmp_path, name):
    content, named = SCENES[name]
    (tmp_path / name).write_bytes(content if isinstance(content, bytes) else content.encode())
    message = refused("compare", name, "--size", "8x8", "--spp", "8")
    assert name in message
    assert named in message


def test_a_folder_or_another_file_is_no_scene(refused, tmp_path):
    (tmp_path / "folder.toml").mkdir()
    (tmp_path / "scene.blend").write_text("")
    assert "folder.toml" in refused("compare", "folder.toml")
    assert "scene.blend" in refused("compare", "scene.blend")
