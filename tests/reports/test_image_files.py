import os
import resource
import struct
import subprocess
import sys
import zlib
from pathlib import Path

import numpy as np
import OpenEXR
import pytest
from PIL import Image

from lightmeter.reports.image_files import write_channels, write_exr
from lightmeter.reports.layers import write_layers
from lightmeter.scenes.image_files.image_error import ImageError
from lightmeter.scenes.image_files.reading import read_image

from .synthetic_pairs import make_pairs


def some_image(height: int = 24, width: int = 40) -> np.ndarray:
    return np.random.default_rng(1).random((height, width, 3)).astype(np.float32) * 50


def chunk(kind: bytes, body: bytes) -> bytes:
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def png(width: int, height: int, depth: int, colour: int, raw: bytes) -> bytes:
    header = struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b"")


def hdr(width: int, height: int, body: bytes, resolution: str = "") -> bytes:
    line = resolution or f"-Y {height} +X {width}"
    return b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + line.encode() + b"\n" + body


def test_exr_round_trip_is_exact(tmp_path: Path) -> None:
    image = some_image()
    image[0, 0] = [np.nan, np.inf, -1.0]
    write_exr(tmp_path / "a.exr", image)
    np.testing.assert_array_equal(read_image(tmp_path / "a.exr"), image)
    assert [item.name for item in tmp_path.iterdir()] == ["a.exr"]


def test_layers_read_back(tmp_path: Path) -> None:
    pairs = make_pairs(24)
    path = write_layers(tmp_path / "all.exr", pairs, {"scene": "ball"})
    for pair in pairs:
        np.testing.assert_array_equal(read_image(path, layer=f"{pair.name}.tested"), pair.tested)
        np.testing.assert_array_equal(read_image(path, layer=f"{pair.name}.truth"), pair.truth)
    np.testing.assert_array_equal(read_image(path), pairs[0].tested)
    with OpenEXR.File(str(path), separate_channels=True) as file:
        assert file.header()["scene"] == "ball"
        np.testing.assert_array_equal(file.channels()["frame.error.flip"].pixels, pairs[0].errors[1].values)
        assert {"shadow_map.tested.R", "shadow_map.error.signed"} <= set(file.channels())


def test_layers_of_two_sizes_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ImageError, match="different sizes"):
        write_layers(tmp_path / "x.exr", [make_pairs(16)[0], make_pairs(20)[1]])
    assert not list(tmp_path.iterdir())


def test_png_is_decoded_from_srgb_unless_told_otherwise(tmp_path: Path) -> None:
    codes = np.arange(256, dtype=np.uint8).reshape(16, 16)
    Image.fromarray(np.stack([codes] * 3, axis=2)).save(tmp_path / "a.png")
    linear = read_image(tmp_path / "a.png")[..., 0].ravel()
    assert linear[0] == 0
    assert linear[255] == pytest.approx(1.0, abs=1e-7)
    assert linear[128] == pytest.approx(0.21586050, abs=1e-6)
    np.testing.assert_allclose(read_image(tmp_path / "a.png", encoding="linear")[..., 0].ravel() * 255, range(256))


@pytest.mark.parametrize("kind", range(5))
def test_png_of_16_bits_keeps_them(tmp_path: Path, kind: int) -> None:
    """Every row filter of the PNG specification, applied here by its definition."""
    values = np.random.default_rng(kind).integers(0, 65536, (6, 5, 3), dtype=np.uint16)
    rows = values.astype(">u2").view(np.uint8).reshape(6, -1).astype(int)
    left = np.pad(rows, ((0, 0), (6, 0)))[:, :-6]
    up = np.pad(rows, ((1, 0), (0, 0)))[:-1]
    corner = np.pad(rows, ((1, 0), (6, 0)))[:-1, :-6]
    guess = left + up - corner
    distances = np.stack([np.abs(guess - left), np.abs(guess - up), np.abs(guess - corner)])
    paeth = np.choose(distances.argmin(axis=0), [left, up, corner])
    predicted = [0 * rows, left, up, (left + up) // 2, paeth][kind]
    filtered = ((rows - predicted) % 256).astype(np.uint8)
    raw = b"".join(bytes([kind]) + row.tobytes() for row in filtered)
    (tmp_path / "a.png").write_bytes(png(5, 6, 16, 2, raw))
    got = read_image(tmp_path / "a.png", encoding="linear")
    np.testing.assert_array_equal(np.round(got * 65535).astype(np.uint16), values)


def test_hdr_flat_and_packed(tmp_path: Path) -> None:
    flat = bytes([128, 64, 0, 129] * 4 + [0, 0, 0, 0] * 4)
    (tmp_path / "a.hdr").write_bytes(hdr(4, 2, flat))
    image = read_image(tmp_path / "a.hdr")
    np.testing.assert_array_equal(image[0, 0], [1.0, 0.5, 0.0])
    assert (image[1] == 0).all()
    (tmp_path / "up.hdr").write_bytes(hdr(4, 2, flat, "+Y 2 +X 4"))
    np.testing.assert_array_equal(read_image(tmp_path / "up.hdr"), image[::-1])
    line = (
        bytes([2, 2, 0, 8]) + bytes([128 + 8, 128]) + bytes([128 + 8, 64]) + bytes([8, *range(8)]) + bytes([136, 129])
    )
    (tmp_path / "b.hdr").write_bytes(hdr(8, 2, line * 2))
    packed = read_image(tmp_path / "b.hdr")
    np.testing.assert_allclose(packed[1, :, 2], np.arange(8) / 128)
    np.testing.assert_array_equal(packed[0, :, 0], np.ones(8))


HOSTILE = {
    "empty": (b"", "an empty file"),
    "text": (b"this is no image at all", "not an image"),
    "jpeg": (b"\xff\xd8\xff\xe0" + bytes(60), "not an image"),
    "exr magic only": (b"\x76\x2f\x31\x01", "cut short"),
    "exr old version": (b"\x76\x2f\x31\x01\x01\0\0\0" + bytes(40), "version"),
    "png signature only": (b"\x89PNG\r\n\x1a\n\0\0\0", "nothing that decodes"),
    "png cut": (png(8, 8, 8, 2, os.urandom(25 * 8))[:120], "damaged|cut"),
    "png of a terabyte": (png(1_000_000, 1_000_000, 8, 2, b""), "too large"),
    "png that lies": (png(8000, 8000, 8, 2, b""), "bytes for the size in its header"),
    "png16 that lies": (png(8000, 8000, 16, 2, b""), "bytes for the size in its header"),
    "png16 cut": (png(8, 8, 16, 2, bytes(49 * 7)), "cut short"),
    "png without pixels": (png(0, 4, 16, 2, b""), "impossible size"),
    "hdr cut": (hdr(16, 16, b"\x02\x02\x00\x10" + b"\xff" * 20), "damaged or cut short|bytes for the size"),
    "hdr that lies": (hdr(8000, 8000, bytes(100)), "bytes for the size in its header"),
    "hdr of a terabyte": (hdr(999_999, 999_999, bytes(100)), "too large"),
    "hdr without resolution": (b"#?RADIANCE\n\nhello\n", "resolution line"),
    "hdr bad exposure": (b"#?RADIANCE\nEXPOSURE=0\n\n-Y 1 +X 1\n0000", "EXPOSURE"),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_file_is_one_clear_error(tmp_path: Path, name: str) -> None:
    data, said = HOSTILE[name]
    path = tmp_path / "x.img"
    path.write_bytes(data)
    with pytest.raises(ImageError, match=said) as caught:
        read_image(path)
    assert str(caught.value).startswith(str(path))


def test_missing_file_folder_and_wrong_layer(tmp_path: Path) -> None:
    with pytest.raises(ImageError, match="no such file"):
        read_image(tmp_path / "none.exr")
    with pytest.raises(ImageError, match="a folder"):
        read_image(tmp_path)
    path = write_layers(tmp_path / "all.exr", make_pairs(16))
    with pytest.raises(ImageError, match=r"no such layer.*frame\.truth"):
        read_image(path, layer="fram.truth")
    write_channels(tmp_path / "z.exr", {"Z": np.zeros((4, 4), np.float32)})
    with pytest.raises(ImageError, match=r"no RGB channels.*found channels Z"):
        read_image(tmp_path / "z.exr")
    write_channels(tmp_path / "y.exr", {"Y": np.full((4, 4), 2, np.float32)})
    assert (read_image(tmp_path / "y.exr") == 2).all()


def test_damaged_exr_is_an_error_and_prints_nothing(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """OpenEXR's reader drops the damaged part with a line on standard output, and says nothing to the caller."""
    # Noise does not compress, is stored as it is, and has no checksum: use what deflate packs.
    path = write_exr(tmp_path / "a.exr", np.round(some_image(64, 64)))
    data = bytearray(path.read_bytes())
    for at in range(600, len(data) - 8, 50):
        data[at] ^= 0xFF
    path.write_bytes(data)
    with pytest.raises(ImageError, match="damaged or cut short"):
        read_image(path)
    path.write_bytes(data[: len(data) // 2])
    with pytest.raises(ImageError, match="damaged or cut short"):
        read_image(path)
    assert capfd.readouterr() == ("", "")


def test_exr_that_claims_a_huge_window_is_refused_before_it_is_allocated(tmp_path: Path) -> None:
    data = bytearray(write_exr(tmp_path / "a.exr", some_image()).read_bytes())
    for name in (b"dataWindow\0box2i\0", b"displayWindow\0box2i\0"):
        at = data.index(name) + len(name) + 4
        data[at : at + 16] = struct.pack("<4i", 0, 0, 7999, 7999)
    (tmp_path / "lie.exr").write_bytes(data)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    with pytest.raises(ImageError, match="bytes for the size in its header"):
        read_image(tmp_path / "lie.exr")
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 50_000


FUZZ = """
import random, sys
from lightmeter.scenes.image_files.image_error import ImageError
from lightmeter.scenes.image_files.reading import read_image
random.seed(7)
sound, path = open(sys.argv[1], "rb").read(), sys.argv[2]
for _ in range(150):
    data = bytearray(sound[: random.choice([len(sound), random.randrange(len(sound))])])
    for _ in range(random.choice([1, 4, 16])):
        if data:
            data[random.randrange(min(len(data), random.choice([420, len(data)])))] = random.randrange(256)
    open(path, "wb").write(data)
    try:
        read_image(path)
    except ImageError:
        pass
print("survived")
"""


@pytest.mark.parametrize("compression", ["NO", "RLE", "ZIP", "PIZ", "PXR24", "B44", "DWAA"])
def test_random_damage_is_never_more_than_an_image_error(tmp_path: Path, compression: str) -> None:
    """In a child process: a crash in the C++ library would end the test run."""
    planes = {"RGB": some_image()}
    header = {"compression": getattr(OpenEXR, f"{compression}_COMPRESSION"), "type": OpenEXR.scanlineimage}
    OpenEXR.File(header, planes).write(str(tmp_path / "a.exr"))
    command = [sys.executable, "-c", FUZZ, str(tmp_path / "a.exr"), str(tmp_path / "b.exr")]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, env=dict(os.environ))
    assert (done.returncode, done.stdout, done.stderr) == (0, "survived\n", "")
