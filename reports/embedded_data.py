"""Pictures as text inside a page: half floats, differences, deflate, base64.

A browser cannot be asked to open a file beside the page, so the HDR data is in the page. Values are scaled by
a power of two so that the largest is just under the half float's limit: nothing overflows, and small values keep
11 bits. Neighbours are subtracted and the two bytes of each number stored apart, which deflate packs better
(a noisy picture by a tenth, a smooth one to a third).
"""

import base64
import zlib
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

# 2^15 is the largest power of two whose double a half float cannot hold.
_TOP = 15


@dataclass(frozen=True)
class PackedImage:
    """A picture as text.

    Attributes:
        width, height, channels: its shape.
        exponent: value = half float · 2^exponent.
        text: base64 of deflate (zlib) of: all high bytes, then all low bytes, of the zigzag-coded differences
            (modulo 2^16, along rows and on from channel to channel) of the half floats' bit patterns.
    """

    width: int
    height: int
    channels: int
    exponent: int
    text: str


def pack_image(image: npt.NDArray[np.floating]) -> PackedImage:
    """`image`, (H, W) or (H, W, C), with the precision of half floats; NaN and infinities stay what they are."""
    planes = image[None] if image.ndim == 2 else np.moveaxis(image, 2, 0)
    magnitudes = np.abs(planes[np.isfinite(planes)])
    largest = float(magnitudes.max()) if magnitudes.size else 0.0
    exponent = int(np.frexp(largest)[1]) - _TOP if largest > 0 else 0
    with np.errstate(over="ignore"):
        halves = np.ldexp(planes.astype(np.float64), -exponent).astype(np.float16)
    steps = np.diff(halves.reshape(-1).view(np.uint16), prepend=np.uint16(0)).astype(np.uint16)
    zigzag = (steps << np.uint16(1)) ^ (np.uint16(0) - (steps >> np.uint16(15)))
    split = np.concatenate([(zigzag >> 8).astype(np.uint8), (zigzag & 255).astype(np.uint8)])
    return PackedImage(image.shape[1], image.shape[0], len(planes), exponent, _packed(split.tobytes()))


def unpack_image(packed: PackedImage) -> npt.NDArray[np.float32]:
    """What `pack_image` packed, as float32 (H, W, C): the page's decoder, in Python, for tests and tools."""
    data = np.frombuffer(zlib.decompress(base64.b64decode(packed.text)), np.uint8).astype(np.uint16)
    count = packed.width * packed.height * packed.channels
    zigzag = (data[:count] << np.uint16(8)) | data[count:]
    steps = (zigzag >> np.uint16(1)) ^ (np.uint16(0) - (zigzag & np.uint16(1)))
    halves = np.cumsum(steps, dtype=np.uint16).view(np.float16)
    planes = halves.reshape(packed.channels, packed.height, packed.width).astype(np.float64)
    return np.moveaxis(np.ldexp(planes, packed.exponent), 0, 2).astype(np.float32)


def pack_mask(mask: npt.NDArray[np.bool_]) -> str:
    """`mask` (H, W) as text: base64 of deflate of one byte per pixel, 1 for True."""
    return _packed(mask.astype(np.uint8).tobytes())


def _packed(data: bytes) -> str:
    return base64.b64encode(zlib.compress(data, 2)).decode("ascii")
