"""Single images on disk, read as float32 scene-linear RGB: OpenEXR, PNG and Radiance HDR.

The kind of file is told by its first bytes, never by its name. Sizes are checked before memory is asked for.
"""

import io
import os
import struct
from collections.abc import Sequence
from pathlib import Path
from typing import Literal

import numpy as np
import numpy.typing as npt

from lightmeter.scenes.image_files import exr_header, exr_planes, png16, rgbe
from lightmeter.scenes.image_files.image_error import ImageError
from lightmeter.scenes.image_files.size_claims import MAX_PIXELS, check_content, check_size

Encoding = Literal["auto", "srgb", "linear"]

_PNG = b"\x89PNG\r\n\x1a\n"


def read_image(
    path: str | os.PathLike[str],
    *,
    encoding: Encoding = "auto",
    layer: str | None = None,
    max_pixels: int = MAX_PIXELS,
) -> npt.NDArray[np.float32]:
    """The image at `path` as float32 (H, W, 3), scene-linear, top row first. Alpha is left out.

    Args:
        encoding: "auto" decodes PNG by the sRGB curve and takes EXR and HDR as linear; "srgb" and "linear" say
            it for any file.
        layer: which layer of an EXR to read ("frame.truth"); None takes the unnamed one, or the only one.
            A file with a single channel Y is read as grey.
        max_pixels: refuse larger pictures before memory is asked for.

    Raises:
        ImageError: a file that is missing, not an image, damaged, too large, or without RGB.
    """
    target = Path(path)
    head = _head(target)
    if layer is not None and not head.startswith(exr_header.MAGIC):
        raise ImageError("no layers", where=path, expected=f"OpenEXR with a layer '{layer}'", actual="another format")
    if head.startswith(exr_header.MAGIC):
        image, own = _read_exr(target, layer, max_pixels), "linear"
    elif head.startswith(_PNG):
        image, own = _read_png(target, head, max_pixels), "srgb"
    elif head.startswith(rgbe.MAGIC):
        image, own = rgbe.read_rgbe(target, max_pixels), "linear"
    else:
        raise ImageError(
            "not an image that can be read",
            where=path,
            expected="OpenEXR, PNG or Radiance HDR",
            actual="an empty file" if not head else f"a file that starts with {head[:8]!r}",
            remedy="Convert it to OpenEXR",
        )
    return _decode_srgb(image) if (own if encoding == "auto" else encoding) == "srgb" else image


def read_alpha(path: str | os.PathLike[str], max_pixels: int = MAX_PIXELS) -> npt.NDArray[np.float32] | None:
    """The opacity of an image that `read_image` read, float32 (H, W), 0…1; None where the file has none.

    Raises:
        ImageError: as `read_image`.
    """
    target = Path(path)
    head = _head(target)
    if head.startswith(exr_header.MAGIC):
        there = "A" in exr_planes.channel_names(target, max_pixels)
        return exr_planes.read_planes(target, ("A",), max_pixels)[0] if there else None
    if not head.startswith(_PNG) or png16.is_png16(head):
        return None
    with _opened(target) as picture:
        if "A" not in picture.getbands() and "transparency" not in picture.info:
            return None
        return np.asarray(picture.convert("RGBA"), np.float32)[..., 3] / np.float32(255)


def _head(path: Path) -> bytes:
    try:
        if path.is_dir():
            raise ImageError("a folder", where=path, expected="an image file")
        with path.open("rb") as file:
            return file.read(32)
    except FileNotFoundError:
        raise ImageError(
            "no such file", where=path, expected="an EXR, PNG or HDR image", remedy="Check the path"
        ) from None
    except OSError as error:
        raise ImageError("cannot be opened", where=path, actual=error.strerror or str(error)) from None


def _read_exr(path: Path, layer: str | None, max_pixels: int) -> npt.NDArray[np.float32]:
    wanted = _wanted_channels(path, exr_planes.channel_names(path, max_pixels), layer)
    return np.ascontiguousarray(np.stack(exr_planes.read_planes(path, wanted, max_pixels), axis=2))


def _wanted_channels(path: Path, names: Sequence[str], layer: str | None) -> tuple[str, str, str]:
    """The three channels of the layer asked for, of the unnamed layer, or of the only layer there is."""
    layers = sorted(name[:-1].rstrip(".") for name in names if name == "R" or name.endswith(".R"))
    layers = [found for found in layers if all(_join(found, part) in names for part in "RGB")]
    if layer is None and "" not in layers and "Y" in names:
        return ("Y", "Y", "Y")
    if layer is None and ("" in layers or len(layers) == 1):
        layer = "" if "" in layers else layers[0]
    if layer in layers:
        return (_join(layer, "R"), _join(layer, "G"), _join(layer, "B"))
    there = [found or "(unnamed)" for found in layers]
    raise ImageError(
        "no RGB channels" if not layers else "several layers" if layer is None else "no such layer",
        where=path,
        expected="R, G and B" if not layers else f"layer '{layer}'" if layer else "one layer",
        actual=f"layers {', '.join(there)}" if layers else f"channels {', '.join(names)}",
        remedy="Say which layer to read" if layers else "Write the image with R, G and B",
    )


def _join(layer: str, channel: str) -> str:
    return f"{layer}.{channel}" if layer else channel


def _read_png(path: Path, head: bytes, max_pixels: int) -> npt.NDArray[np.float32]:
    """Code values over their maximum, float32 (H, W, 3)."""
    if png16.is_png16(head):
        return (png16.read_png16(path, max_pixels) / np.float32(65535)).astype(np.float32)
    from PIL import Image

    if len(head) >= 24:  # before Pillow, which has a limit and a warning of its own
        check_size(path, *struct.unpack(">II", head[16:24]), max_pixels)
    try:
        with _opened(path) as picture:
            bits = picture.width * picture.height * (1 if picture.mode == "1" else 8)
            check_content(path, bits // 8, path.stat().st_size, 1100.0)
            if picture.mode.startswith("I"):
                grey = np.asarray(picture, np.float32) / np.float32(65535)
                return np.repeat(grey[..., None], 3, axis=2)
            return np.asarray(picture.convert("RGB"), np.float32) / np.float32(255)
    except ImageError:
        raise
    # Pillow's decoders raise what their parser happens to meet.
    except (OSError, SyntaxError, ValueError, EOFError, Image.DecompressionBombError) as error:
        raise ImageError(
            "damaged or cut short", where=path, actual=_found(error), remedy="Write or copy the file again"
        ) from None


def _found(error: Exception) -> str:
    """What a decoder met; Pillow names the object in memory where it makes nothing of a file at all."""
    from PIL import UnidentifiedImageError

    return "nothing that decodes as a picture" if isinstance(error, UnidentifiedImageError) else str(error)


def _opened(path: Path):
    """Pillow's picture of a PNG file, from memory: of a file it asks for as much as a damaged length claims."""
    from PIL import Image

    return Image.open(io.BytesIO(path.read_bytes()), formats=("PNG",))


def _decode_srgb(image: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
    """IEC 61966-2-1 code values to linear."""
    bent = np.maximum((image + np.float32(0.055)) / np.float32(1.055), 0) ** np.float32(2.4)
    return np.where(image <= 0.04045, image / np.float32(12.92), bent).astype(np.float32)
