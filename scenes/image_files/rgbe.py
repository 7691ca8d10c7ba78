"""Radiance HDR (RGBE) files, after Greg Ward, "Real Pixels", Graphics Gems II, 1991.

A stored mantissa m and exponent e mean m · 2^(e − 136), as in Bruce Walter's `rgbe.c`, Mitsuba and most engines.
Radiance itself adds half a step to m; then a stored 0 would not be black beside a bright channel.
"""

import re
from pathlib import Path

import numpy as np
import numpy.typing as npt

from lightmeter.scenes.image_files.image_error import ImageError
from lightmeter.scenes.image_files.size_claims import MAX_PIXELS, check_content, check_size

MAGIC = (b"#?RADIANCE", b"#?RGBE", b"#?AUTOPANO")

_HEADER_LIMIT = 2**16
_RESOLUTION = re.compile(rb"^([-+])Y (\d{1,9}) ([-+])X (\d{1,9})$")


def read_rgbe(path: Path, max_pixels: int = MAX_PIXELS) -> npt.NDArray[np.float32]:
    """The picture at `path` as float32 (H, W, 3), scene-linear, top row first; `EXPOSURE` lines are undone.

    Raises:
        ImageError: a damaged or cut file, a size that is too large, XYZE colours, or a rotated picture.
    """
    data = path.read_bytes()
    flips, (width, height), exposure, start = _header(path, data)
    check_size(path, width, height, max_pixels)
    # A run of at most 127 bytes takes 2.
    check_content(path, 4 * width * height, len(data) - start, 64.0)
    pixels = _scanlines(path, data, start, width, height)
    scale = np.ldexp(1.0, pixels[..., 3].astype(np.int32) - 136)
    scale = np.where(pixels[..., 3] == 0, 0.0, scale / exposure)
    image = (pixels[..., :3] * scale[..., None]).astype(np.float32)
    return np.ascontiguousarray(image[:: flips[1], :: flips[0]])


def _header(path: Path, data: bytes) -> tuple[tuple[int, int], tuple[int, int], float, int]:
    """((x step, y step), (width, height), exposure, offset of the first scanline)."""
    end = data.find(b"\n\n", 0, _HEADER_LIMIT)
    stop = data.find(b"\n", end + 2, end + 2 + 64)
    if end < 0 or stop < 0:
        raise ImageError("damaged or cut short", where=path, expected="an HDR header and a resolution line")
    exposure = 1.0
    for line in data[:end].split(b"\n"):
        key, _, value = line.partition(b"=")
        if key.strip() == b"FORMAT" and value.strip() != b"32-bit_rle_rgbe":
            raise ImageError(
                "unknown HDR format", where=path, expected="32-bit_rle_rgbe", actual=repr(value.strip()[:40])
            )
        if key.strip() == b"EXPOSURE":
            exposure *= _positive(path, value)
    found = _RESOLUTION.match(data[end + 2 : stop])
    if not found:
        raise ImageError(
            "unknown HDR resolution line",
            where=path,
            expected="-Y height +X width",
            actual=repr(data[end + 2 : stop][:40]),
        )
    y_sign, height, x_sign, width = found.groups()
    steps = (1 if x_sign == b"+" else -1, 1 if y_sign == b"-" else -1)
    return steps, (int(width), int(height)), exposure, stop + 1


def _positive(path: Path, value: bytes) -> float:
    try:
        number = float(value)
    except ValueError:
        number = 0.0
    if not 0 < number < 1e30:
        raise ImageError("damaged HDR header", where=path, expected="EXPOSURE above 0", actual=repr(value[:40]))
    return number


def _scanlines(path: Path, data: bytes, at: int, width: int, height: int) -> npt.NDArray[np.uint8]:
    """The stored bytes, uint8 (height, width, 4)."""
    pixels = np.empty((height, width, 4), np.uint8)
    marker = bytes((2, 2, width >> 8, width & 0xFF)) if 8 <= width < 0x8000 else None
    for row in range(height):
        if marker and data[at : at + 4] == marker:
            line, at = _packed_line(path, data, at + 4, width, row)
            pixels[row] = np.frombuffer(line, np.uint8).reshape(4, width).T
            continue
        line = data[at : at + 4 * width]
        if len(line) < 4 * width:
            raise _cut(path, row)
        pixels[row] = np.frombuffer(line, np.uint8).reshape(width, 4)
        if (pixels[row, :, :3] == 1).all(axis=1).any():
            raise ImageError(
                "old run-length HDR",
                where=path,
                expected="plain or new run-length scanlines",
                remedy="Write the file again with a current tool",
            )
        at += 4 * width
    return pixels


def _packed_line(path: Path, data: bytes, at: int, width: int, row: int) -> tuple[bytearray, int]:
    """One scanline's four components in turn, and the offset behind it."""
    line = bytearray()
    for component in range(1, 5):
        while len(line) < component * width:
            if at + 1 >= len(data):
                raise _cut(path, row)
            count = data[at]
            if count > 128:
                line += data[at + 1 : at + 2] * (count - 128)
                at += 2
            else:
                line += data[at + 1 : at + 1 + count]
                at += 1 + count
            if count == 0 or at > len(data) or len(line) > component * width:
                raise _cut(path, row)
    return line, at


def _cut(path: Path, row: int) -> ImageError:
    return ImageError(
        "damaged or cut short",
        where=path,
        actual=f"no sound scanline {row}",
        remedy="Write or copy the file again",
    )
