"""The header of an OpenEXR file, read by hand before the library may touch the file.

OpenEXR's reader trusts a header's sizes with memory. This reads only what decides the allocation: parts,
data windows, channels and compression. Layout: https://openexr.com/en/latest/OpenEXRFileLayout.html
"""

import struct
from dataclasses import dataclass
from pathlib import Path

from lightmeter.scenes.image_files.image_error import ImageError
from lightmeter.scenes.image_files.size_claims import MAX_PIXELS, check_content, check_size

MAGIC = b"\x76\x2f\x31\x01"

_HEADER_LIMIT = 2**20
_MULTIPART, _DEEP = 0x1000, 0x0800
_CHANNEL_LIMIT = 1024
_BYTES = {0: 4, 1: 2, 2: 4}  # UINT, HALF, FLOAT
# Bytes out per byte in, at best: none, RLE (128 bytes in 2), ZIPS and ZIP (deflate: 1032), PXR24 (deflate of
# three bytes in four), B44 and B44A (32 bytes in 3). The others reach some 25 000 on a black picture.
_RATIO = {0: 1.0, 1: 64.0, 2: 1100.0, 3: 1100.0, 5: 1500.0, 6: 11.0, 7: 11.0}
_RATIO_OTHERS = 100_000.0


@dataclass(frozen=True)
class ExrPart:
    """What one part claims: (width, height) of its data window and its channels' names."""

    size: tuple[int, int]
    channels: tuple[str, ...]


def check_exr(path: Path, max_pixels: int = MAX_PIXELS) -> tuple[ExrPart, ...]:
    """The parts of the file at `path`, once its header has been found sound.

    Raises:
        ImageError: not OpenEXR, a header that breaks off or contradicts itself, deep data, or sizes that are too
            large or that the file is too short for.
    """
    with path.open("rb") as file:
        head = file.read(_HEADER_LIMIT)
    present = path.stat().st_size
    cursor = _Cursor(head, path)
    if cursor.take(4, "magic number") != MAGIC:
        raise ImageError("not OpenEXR", where=path, expected=repr(MAGIC), actual=repr(head[:4]))
    version = cursor.integer("version")
    if version & 0xFF != 2:
        raise ImageError("unknown OpenEXR version", where=path, expected="2", actual=str(version & 0xFF))
    if version & _DEEP:
        raise ImageError("deep data", where=path, expected="flat pixels", remedy="Flatten the image and write it again")
    parts = []
    claimed = 0
    while True:
        attributes = cursor.attributes()
        if not attributes and parts:
            break
        part, size = _part(path, attributes, max_pixels)
        parts.append(part)
        claimed += size
        if not version & _MULTIPART:
            break
    check_content(path, claimed, present, 1.0)
    return tuple(parts)


def _part(path: Path, attributes: dict[str, bytes], max_pixels: int) -> tuple[ExrPart, int]:
    """One part, and the number of bytes that the file must at least have for it."""
    window = _window(path, attributes, "dataWindow")
    _window(path, attributes, "displayWindow")
    width, height = window[2] - window[0] + 1, window[3] - window[1] + 1
    check_size(path, width, height, max_pixels)
    channels = _channels(path, attributes.get("channels", b""))
    compression = attributes.get("compression", b"\xff")[0]
    raw = width * height * sum(size for _, size in channels)
    if raw > 64 * max_pixels:  # sixteen float channels of the largest picture
        raise ImageError(
            "too large, or damaged", where=path, actual=f"{len(channels)} channels of {width}×{height} pixels"
        )
    needed = int(raw / _RATIO.get(compression, _RATIO_OTHERS))
    return ExrPart((width, height), tuple(name for name, _ in channels)), needed


def _window(path: Path, attributes: dict[str, bytes], name: str) -> tuple[int, int, int, int]:
    value = attributes.get(name, b"")
    if len(value) != 16:
        raise ImageError("damaged header", where=path, expected=f"a {name} of 16 bytes", actual=f"{len(value)}")
    return struct.unpack("<4i", value)


def _channels(path: Path, value: bytes) -> list[tuple[str, int]]:
    """Names and bytes per sample, from a `chlist` attribute."""
    cursor = _Cursor(value, path)
    found = []
    while name := cursor.word("channel name"):
        kind = cursor.integer("channel type")
        cursor.take(4, "channel flags")
        sampling = (cursor.integer("channel sampling"), cursor.integer("channel sampling"))
        if kind not in _BYTES or len(found) >= _CHANNEL_LIMIT:
            raise ImageError("damaged header", where=path, actual=f"channel '{name}' of type {kind}")
        if sampling != (1, 1):
            raise ImageError(
                "sub-sampled channels",
                where=path,
                expected="a sample per pixel",
                actual=f"channel '{name}' sampled {sampling[0]}×{sampling[1]}",
                remedy="Write the image as R, G, B",
            )
        found.append((name, _BYTES[kind]))
    if not found:
        raise ImageError("no channels", where=path, expected="R, G and B")
    return found


class _Cursor:
    """Reads on through bytes; what is missing is an `ImageError`."""

    def __init__(self, data: bytes, path: Path) -> None:
        self.data = data
        self.path = path
        self.at = 0

    def take(self, count: int, what: str) -> bytes:
        taken = self.data[self.at : self.at + count]
        if count < 0 or len(taken) < count:
            raise ImageError(
                "damaged or cut short",
                where=self.path,
                expected=f"{what} at byte {self.at} of its header",
                actual="the end",
                remedy="Write or copy the file again",
            )
        self.at += count
        return taken

    def integer(self, what: str) -> int:
        return struct.unpack("<i", self.take(4, what))[0]

    def word(self, what: str) -> str:
        """A name that ends with a zero byte; "" is the end of a list."""
        end = self.data.find(b"\0", self.at, self.at + 256)
        if end < 0:
            self.take(len(self.data), what)
            raise ImageError("damaged header", where=self.path, actual=f"no end of the {what} at byte {self.at}")
        found = self.data[self.at : end].decode("utf-8", "replace")
        self.at = end + 1
        return found

    def attributes(self) -> dict[str, bytes]:
        found = {}
        while name := self.word("attribute name"):
            self.word("attribute type")
            found[name] = self.take(self.integer("attribute size"), f"attribute '{name}'")
        return found
