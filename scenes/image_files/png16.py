"""PNG files with 16 bits per sample in colour, which Pillow would silently read with 8."""

import struct
import zlib
from pathlib import Path

import numpy as np
import numpy.typing as npt

from lightmeter.scenes.image_files.image_error import ImageError
from lightmeter.scenes.image_files.size_claims import MAX_PIXELS, check_content, check_size

_SIGNATURE = b"\x89PNG\r\n\x1a\n"
_SAMPLES = {2: 3, 6: 4}  # colour type: samples per pixel
_HEADER = 33  # bytes: signature and IHDR


def is_png16(head: bytes) -> bool:
    """Whether `head`, the first 26 bytes of a file, opens a 16-bit colour PNG."""
    whole = len(head) >= 26 and head[:8] == _SIGNATURE and head[12:16] == b"IHDR"
    return whole and head[24] == 16 and head[25] in _SAMPLES


def read_png16(path: Path, max_pixels: int = MAX_PIXELS) -> npt.NDArray[np.uint16]:
    """The picture's stored values, uint16 (H, W, 3); alpha is left out.

    Raises:
        ImageError: a damaged or cut file, a size that is too large, or an interlaced picture.
    """
    data = path.read_bytes()
    if len(data) < _HEADER:
        raise ImageError("PNG cut short", where=path, expected=f"{_HEADER} bytes of header", actual=f"{len(data)}")
    width, height = struct.unpack(">II", data[16:24])
    samples = _SAMPLES[data[25]]
    check_size(path, width, height, max_pixels)
    stride = 2 * samples * width
    check_content(path, (stride + 1) * height, len(data), 1100.0)
    if data[28]:
        raise ImageError("interlaced 16-bit PNG", where=path, remedy="Write it without interlacing, or as EXR")
    try:
        unpacked = zlib.decompressobj().decompress(_packed(path, data), (stride + 1) * height)
    except zlib.error as error:
        raise ImageError("damaged PNG", where=path, actual=str(error)) from None
    if len(unpacked) != (stride + 1) * height:
        raise ImageError(
            "PNG cut short", where=path, expected=f"{height} rows", actual=f"{len(unpacked) // (stride + 1)}"
        )
    rows = np.empty((height, stride), np.uint8)
    above = bytes(stride)
    for row in range(height):
        start = row * (stride + 1)
        above = _unfilter(path, unpacked[start], unpacked[start + 1 : start + 1 + stride], above, 2 * samples)
        rows[row] = np.frombuffer(above, np.uint8)
    return rows.view(">u2").reshape(height, width, samples)[..., :3].astype(np.uint16)


def _packed(path: Path, data: bytes) -> bytes:
    """The IDAT chunks' contents, checked against their sums."""
    found = []
    at = 8
    while at + 12 <= len(data):
        length = struct.unpack(">I", data[at : at + 4])[0]
        kind, body = data[at + 4 : at + 8], data[at + 8 : at + 8 + length]
        if len(body) < length or data[at + 8 + length : at + 12 + length] != struct.pack(">I", zlib.crc32(kind + body)):
            raise ImageError("damaged or cut short", where=path, actual=f"a broken chunk at byte {at}")
        if kind == b"IDAT":
            found.append(body)
        if kind == b"IEND":
            break
        at += 12 + length
    return b"".join(found)


def _unfilter(path: Path, kind: int, line: bytes, above: bytes, step: int) -> bytes:
    """One row with its filter undone (PNG specification, section 9); `step` is the bytes per pixel."""
    if kind == 0:
        return line
    if kind == 1:
        lanes = np.frombuffer(line, np.uint8).reshape(-1, step)
        return np.cumsum(lanes, axis=0, dtype=np.uint8).tobytes()
    if kind == 2:
        return (np.frombuffer(line, np.uint8) + np.frombuffer(above, np.uint8)).tobytes()
    if kind not in (3, 4):
        raise ImageError("damaged PNG", where=path, expected="row filter 0 to 4", actual=str(kind))
    out = bytearray(step) + bytearray(line)
    over = bytes(step) + above
    for at in range(step, len(out)):
        left, up = out[at - step], over[at]
        guess = (left + up) >> 1 if kind == 3 else _paeth(left, up, over[at - step])
        out[at] = (out[at] + guess) & 0xFF
    return bytes(out[step:])


def _paeth(left: int, up: int, corner: int) -> int:
    near_left, near_up, near_corner = abs(up - corner), abs(left - corner), abs(left + up - 2 * corner)
    if near_left <= near_up and near_left <= near_corner:
        return left
    return up if near_up <= near_corner else corner
