"""What is fuzzed: every loader of files that a user hands in, with sound files to start from."""

import io
import struct
import tempfile
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lightmeter.failures import UsageError
from lightmeter.limits import read_rules
from lightmeter.reports.image_files import write_exr
from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.image_files.image_error import ImageError
from lightmeter.scenes.image_files.reading import read_image
from lightmeter.scenes.load import load
from lightmeter.scenes.obj import load_obj
from lightmeter.scenes.ply import load_ply

from ..harness.small_images import hdr, noise
from ..scenes.test_fuzz_loaders import CHECKER, FILES, OBJ, gltf

DOCUMENTED = (SceneError, ImageError, UsageError)
"""What a loader may raise."""

LIMITS = b"""[budget]
seconds = 120
confidence = 0.999
[defaults]
size = "64x64"
spp = 64
seed = 3
set = { shadow_map.resolution = 2048 }
[[limit]]
scene = "scenes/*.toml"
of = "frame"
metric = "flip"
max = 0.12
region = { background = false }
[[limit]]
scene = "posts"
of = "shadow_map"
metric = "time_ratio"
to = "frame"
max = 0.6
use = ["pcss"]
[[candidate]]
name = "our engine"
command = "engine {gltf} {camera_json} {w} {h} {exr}"
[[limit]]
scene = "posts"
candidate = "our engine"
metric = "ssim"
min = 0.9
"""


@dataclass(frozen=True)
class Loader:
    """One way in.

    Attributes:
        name: on the command line and in findings.
        file: the name that a mutated file is given.
        seeds: sound files.
        read: the loader, given the file's path.
        repair: mends a damaged file's lengths and sums, so that the damage gets past the first check.
    """

    name: str
    file: str
    seeds: tuple[bytes, ...]
    read: Callable[[Path], object]
    repair: Callable[[bytes], bytes] = bytes


def png16(values: np.ndarray) -> bytes:
    """A 16-bit RGB PNG, unfiltered rows."""

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    height, width = values.shape[:2]
    rows = b"".join(b"\0" + row.astype(">u2").tobytes() for row in (values * 65535).astype(np.uint16))
    head = struct.pack(">IIBBBBB", width, height, 16, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def with_png_sums(data: bytes) -> bytes:
    """The chunks' sums made right, as far as their lengths lead."""
    mended, at = bytearray(data), 8
    while at + 12 <= len(data):
        end = at + 8 + int.from_bytes(data[at : at + 4], "big")
        mended[end : end + 4] = struct.pack(">I", zlib.crc32(data[at + 4 : end])) if end + 4 <= len(data) else b""
        at = end + 4
    return bytes(mended)


def with_glb_lengths(data: bytes) -> bytes:
    """The lengths of the file and of its two chunks made right, where both are still to be found."""
    json, mark, binary = data[20:].partition(b"BIN\0")
    if not mark:
        return data
    text = json[:-4] + b" " * (-len(json[:-4]) % 4)
    binary += bytes(-len(binary) % 4)
    whole = struct.pack("<I", len(text)) + b"JSON" + text + struct.pack("<I", len(binary)) + mark + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(whole)) + whole


def _written(write: Callable[[Path], object], name: str) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        write(Path(folder) / name)
        return (Path(folder) / name).read_bytes()


def _pillow(mode: str) -> bytes:
    from PIL import Image

    stream = io.BytesIO()
    Image.fromarray((noise(6, 5) * 255).astype(np.uint8)).convert(mode).save(stream, "png")
    return stream.getvalue()


def loaders() -> dict[str, Loader]:
    """All of them, by name."""
    image = noise(6, 5)
    inline = _written(lambda path: gltf().save(path.parent, path.name), "scene.gltf")
    pngs = (CHECKER, png16(image), *map(_pillow, ("L", "P", "RGBA", "1", "LA")))
    found = (
        Loader("toml", "scene.toml", (FILES["scene.toml"],), load),
        Loader("gltf", "scene.gltf", (inline,), load),
        Loader("glb", "scene.glb", (FILES["scene.glb"],), load, with_glb_lengths),
        Loader("obj", "mesh.obj", (OBJ.encode(),), load_obj),
        Loader("ply", "mesh.ply", tuple(FILES[f"{kind}.ply"] for kind in ("ascii", "little", "big")), load_ply),
        Loader("png", "image.png", pngs, read_image, with_png_sums),
        Loader("exr", "image.exr", (_written(lambda path: write_exr(path, image), "image.exr"),), read_image),
        Loader("hdr", "image.hdr", (_written(lambda path: hdr(path, noise(9, 5)), "image.hdr"),), read_image),
        Loader("limits", "lightmeter.toml", (LIMITS,), read_rules),
    )
    return {loader.name: loader for loader in found}


def put_neighbours(folder: Path) -> None:
    """The sound files that a scene file in `folder` may name."""
    (folder / "checker.png").write_bytes(CHECKER)
    (folder / "mesh.obj").write_text(OBJ)
