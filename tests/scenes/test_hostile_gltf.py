"""Damaged and lying glTF files: each ends in a SceneError that names the place, quickly and in little memory."""

import base64
import json
import struct
import tracemalloc
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.load import load

from .synthetic_gltf import QUAD, TWO, Writer, glb, png, quad

CHECKER = png(np.zeros((2, 2, 3), np.uint8))
ENOUGH = 64 * 2**20
"""Bytes that reading a bad file may take."""


def refused(path: Path) -> str:
    """The message with which a file is refused."""
    tracemalloc.start()
    try:
        with pytest.raises(SceneError) as caught:
            load(path)
        assert tracemalloc.get_traced_memory()[1] < ENOUGH
    finally:
        tracemalloc.stop()
    message = str(caught.value)
    assert str(path) in message and "\n" not in message and len(message) < 2000
    return message


def spoiled(tmp_path: Path, spoil: Callable[[dict[str, Any]], object]) -> str:
    """The message after `spoil` changed the JSON of a good file with a textured quad, a camera and a light."""
    writer = quad()
    info = {"index": writer.texture(CHECKER)}
    writer.node(mesh=writer.mesh(material={"pbrMetallicRoughness": {"baseColorTexture": info}}))
    content = writer.finished(inline=True)
    spoil(content)
    path = tmp_path / "bad.gltf"
    path.write_text(json.dumps(content))
    return refused(path)


def put(*path_and_value: Any) -> Callable[[dict[str, Any]], None]:
    """A change of one value."""
    *path, last, value = path_and_value

    def spoil(content: Any) -> None:
        for key in path:
            content = content[key]
        content[last] = value

    return spoil


POSITION = ("accessors", 0)


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (put(*POSITION, "count", 10**15), "accessors[0].count"),
        (put(*POSITION, "count", 20_000_000), "reaches beyond its buffer view"),
        (put(*POSITION, "count", -1), "accessors[0].count"),
        (put(*POSITION, "count", "4"), "accessors[0].count"),
        (put(*POSITION, "count", 2**70), "accessors[0].count"),
        (put("accessors", 1, "count", 3), "NORMAL has another length"),
        (put(*POSITION, "type", "VEC2"), "expected VEC3, got VEC2"),
        (put(*POSITION, "type", "MAT4"), "expected VEC3, got MAT4"),
        (put(*POSITION, "componentType", 5124), "componentType"),
        (put(*POSITION, "byteOffset", 2**40), "reaches beyond its buffer view"),
        (put(*POSITION, "bufferView", 99), "there is no bufferViews[99]"),
        (put("bufferViews", 0, "byteLength", 2**31), "reaches beyond its buffer"),
        (put("bufferViews", 0, "byteStride", 4), "stride is smaller than an element"),
        (put("bufferViews", 0, "byteStride", 10**6), "byteStride"),
        (put("bufferViews", 0, "buffer", 7), "there is no buffers[7]"),
        (put("buffers", 0, "byteLength", 2**40), "the buffer is truncated"),
        (put("buffers", 0, "uri", "missing.bin"), "there is no such file"),
        (put("buffers", 0, "uri", "../../secret.bin"), "leads out of the scene's folder"),
        (put("buffers", 0, "uri", "%2e%2e/secret.bin"), "leads out of the scene's folder"),
        (put("buffers", 0, "uri", "/etc/passwd"), "absolute"),
        (put("buffers", 0, "uri", "file:///etc/passwd"), "nothing is fetched"),
        (put("buffers", 0, "uri", "http://example.org/a.bin"), "nothing is fetched"),
        (put("buffers", 0, "uri", "data:;base64,###"), "data URI is damaged"),
        (put("buffers", 0, "uri", "a\0b"), "no file name"),
        (put("buffers", 0, {}), "buffers[0]"),
        (put("images", 0, {"uri": "."}), "images[0]"),
        (put("images", 0, {"bufferView": 0}), "the image cannot be read"),
        (put("images", 0, {}), "neither uri nor bufferView"),
        (put("textures", 0, "source", 5), "there is no images[5]"),
        (put("meshes", 0, "primitives", 0, "indices", 0), "componentType"),
        (put("meshes", 0, "primitives", 0, "material", 50), "there is no materials[50]"),
        (put("meshes", 0, "primitives", 0, "mode", 9), "mode"),
        (put("meshes", 0, "primitives", 0, "attributes", {"POSITION": "x"}), "attributes.POSITION"),
        (put("meshes", 0, "primitives", []), "primitives"),
        (put("nodes", 0, "children", [0]), "reached twice"),
        (put("nodes", 0, "children", [1]), "reached twice"),
        (put("nodes", 0, "children", [77]), "there is no nodes[77]"),
        (put("nodes", 0, "mesh", 1.5), "nodes[0].mesh"),
        (put("nodes", 0, "scale", [1e30, 1e30, 1e30]), "not finite, or too far away"),
        (put("nodes", 0, "scale", [1e31, 1, 1]), "nodes[0].scale"),
        (put("nodes", 0, "matrix", [1] * 15), "nodes[0].matrix"),
        (put("nodes", 0, "rotation", [0, 0, 0, 0]), "quaternion"),
        (put("scenes", 0, "nodes", "all"), "scenes[0].nodes"),
        (put("scene", 3), "there is no scenes[3]"),
        (put("asset", {}), "asset.version"),
        (put("asset", "version", "1.0"), "expected 2.x"),
        (put("extensionsRequired", ["KHR_draco_mesh_compression"]), "KHR_draco_mesh_compression"),
        (put("materials", 0, "pbrMetallicRoughness", "metallicFactor", 2), "metallicFactor"),
        (put("materials", 0, "alphaMode", "blend"), "expected one of OPAQUE, MASK, BLEND"),
        (put("materials", 0, None), "materials[0]"),
        (put("nodes", {}), "nodes"),
        (put("meshes", None), "meshes"),
    ],
)  # fmt: skip
def test_a_spoiled_value_is_named(tmp_path, spoil, words):
    assert words in spoiled(tmp_path, spoil)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_positions_that_are_not_finite(tmp_path, bad):
    writer = Writer()
    positions = QUAD.copy()
    positions[2, 1] = bad
    writer.node(mesh=writer.mesh(POSITION=positions))
    assert "accessors[0], element 2" in refused(writer.save(tmp_path))


def test_an_index_out_of_range(tmp_path):
    writer = Writer()
    indices = TWO.copy()
    indices[4] = 4
    writer.node(mesh=writer.mesh(indices, POSITION=QUAD))
    message = refused(writer.save(tmp_path))
    assert "element 4" in message and "expected 0 to 3, got 4" in message


def test_incomplete_triangles(tmp_path):
    writer = Writer()
    writer.node(mesh=writer.mesh(TWO[:4], POSITION=QUAD))
    assert "multiple of 3" in refused(writer.save(tmp_path))


@pytest.mark.parametrize("indices", [[1, 9], [2, 1]])
def test_sparse_indices_that_lie(tmp_path, indices):
    writer = Writer()
    sparse = {
        "count": 2,
        "indices": {"bufferView": writer.view(np.uint8(indices).tobytes()), "componentType": 5121},
        "values": {"bufferView": writer.view(np.zeros(6, np.float32).tobytes())},
    }
    writer.node(mesh=writer.mesh(POSITION=writer.accessor(QUAD, sparse=sparse)))
    assert "sparse indices" in refused(writer.save(tmp_path))


def test_every_truncation_of_a_glb(tmp_path):
    data = quad().save(tmp_path, "scene.glb").read_bytes()
    path = tmp_path / "cut.glb"
    for end in (*range(40), *range(40, len(data), 37)):
        path.write_bytes(data[:end])
        with pytest.raises(SceneError):
            load(path)


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "no valid JSON"),
        (b"{", "no valid JSON"),
        (b"\xff\xfe{}", "no valid JSON"),
        (b"[]", "a JSON object"),
        (b"null", "a JSON object"),
        (b"{}", "asset"),
        (b'{"asset": {"version": NaN}}', "NaN"),
        (b'{"asset": Infinity}', "Infinity"),
        (b"[" * 100_000, "nested too deeply"),
        (b'{"a":' * 100_000, "nested too deeply"),
        (b'{"asset":' + b"[" * 900 + b"]" * 900 + b"}", "asset"),
        (b'{"a": ' + b"9" * 10_000 + b"}", "no valid JSON"),
        (b"[" + b"[]," * 4_000_001, "too large"),
        (b"glTF" + struct.pack("<II", 1, 20) + bytes(8), "version"),
        (b"glTF" + struct.pack("<II", 2, 2**31) + bytes(8), "truncated"),
        (b"glTF" + struct.pack("<II", 2, 20) + struct.pack("<I4s", 0, b"BIN\0"), "not JSON"),
        (b"glTF" + struct.pack("<II", 2, 20) + struct.pack("<I4s", 2**32 - 1, b"JSON"), "truncated"),
    ],
)
def test_what_is_no_gltf(tmp_path, data, words):
    path = tmp_path / "bad.gltf"
    path.write_bytes(data)
    assert words in refused(path)


def test_deep_and_wide_nodes(tmp_path):
    """A chain of 10 000 nodes is a valid tree; the same with scales overflows; a shared child is refused."""
    writer = quad()
    for index in range(1, 10_000):
        writer.node(root=False, children=[index + 1] if index < 9_999 else [])
    writer.content["nodes"][0]["children"] = [1]
    assert len(load(writer.save(tmp_path)).shapes) == 1
    for node in writer.content["nodes"]:
        node["scale"] = [10, 10, 10]
    assert "stands nowhere finite" in refused(writer.save(tmp_path))
    writer = Writer()
    writer.mesh()
    for index in range(40):  # each names the next twice: 2⁴⁰ paths
        writer.node(root=index == 0, mesh=0, children=[index + 1] * 2 if index < 39 else [])
    assert "reached twice" in refused(writer.save(tmp_path))


def test_many_instances_of_a_mesh_are_refused_before_they_fill_the_memory(tmp_path):
    writer = quad()
    for _ in range(21_000):
        writer.node(mesh=0)
    with pytest.raises(SceneError, match="too large"):
        load(writer.save(tmp_path))


def _bomb(width: int, height: int) -> bytes:
    """A small PNG that unpacks to width × height texels."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(b"")) + chunk(b"IEND", b"")


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (_bomb(60_000, 60_000), "image"),
        (_bomb(9_000, 9_000), "the image is too large"),
        (_bomb(2**31 - 1, 2**31 - 1), "image"),
        (_bomb(0, 5), "image"),
        (_bomb(4, 4), "the image cannot be read"),
        (CHECKER[:40], "the image cannot be read"),
        (CHECKER[:-30], "the image cannot be read"),
        (b"RIFF\x10\0\0\0WEBPVP8 ", "a WebP file"),
        (b"\xabKTX 20\xbb\r\n\x1a\n", "a KTX2 file"),
        (b"GIF89a", "a GIF file"),
        (b"x", "the image cannot be read"),
    ],
)
def test_bad_images(tmp_path, data, words):
    writer = Writer()
    texture = {"index": writer.texture(data)}
    writer.node(mesh=writer.mesh(material={"emissiveTexture": texture}))
    message = refused(writer.save(tmp_path))
    assert words in message and "images[0]" in message


@pytest.mark.parametrize(
    "light",
    [
        {"type": "area"},
        {"type": "spot"},
        {"type": "spot", "spot": {"innerConeAngle": 0.5, "outerConeAngle": 0.5}},
        {"type": "spot", "spot": {"outerConeAngle": 2}},
        {"type": "point", "intensity": -1},
        {"type": "point", "color": [1, 1]},
    ],
)
def test_bad_lights(tmp_path, light):
    writer = quad(extensions={"KHR_lights_punctual": {"light": 0}})
    writer.content["extensions"] = {"KHR_lights_punctual": {"lights": [light]}}
    assert "lights[0]" in refused(writer.save(tmp_path))


@pytest.mark.parametrize(
    "camera",
    [
        {"type": "fisheye"},
        {"type": "perspective"},
        {"type": "perspective", "perspective": {"yfov": 4, "znear": 1}},
        {"type": "perspective", "perspective": {"yfov": 1, "znear": 0}},
        {"type": "perspective", "perspective": {"yfov": 1, "znear": 2, "zfar": 1}},
        {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 0, "znear": 0, "zfar": 1}},
    ],
)
def test_bad_cameras(tmp_path, camera):
    writer = quad(camera=0)
    writer.content["cameras"] = [camera]
    assert "cameras[0]" in refused(writer.save(tmp_path))


def test_a_camera_that_is_not_there(tmp_path):
    writer = quad(camera=0, name="front")
    writer.content["cameras"] = [{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}]
    path = writer.save(tmp_path)
    with pytest.raises(SceneError, match=r"[Dd]id you mean 'front'\?"):
        load(path, camera="frnt")


def test_a_link_that_leads_out_of_the_folder(tmp_path):
    (tmp_path / "secret.bin").write_bytes(bytes(1000))
    (tmp_path / "scene").mkdir()
    (tmp_path / "scene" / "data.bin").symlink_to(tmp_path / "secret.bin")
    writer = quad()
    writer.content["buffers"][0]["uri"] = "data.bin"
    assert "leads out" in refused(writer.save(tmp_path / "scene"))


def test_a_second_buffer_without_uri(tmp_path):
    writer = quad()
    writer.content["buffers"].append({"byteLength": 4})
    writer.content["bufferViews"][0]["buffer"] = 1
    path = tmp_path / "bad.glb"
    path.write_bytes(glb(writer.finished(inline=False), bytes(writer.binary)))
    assert "buffers[1]" in refused(path)


def test_a_missing_file_and_a_folder(tmp_path):
    assert "no such file" in refused(tmp_path / "none.glb")
    (tmp_path / "folder.glb").mkdir()
    assert "not a file" in refused(tmp_path / "folder.glb")


def test_data_uris_are_strict(tmp_path):
    data = base64.b64encode(b"x").decode()
    message = spoiled(tmp_path, put("buffers", 0, "uri", f"data:application/octet-stream,{data}"))
    assert "data URI is damaged" in message
