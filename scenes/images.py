"""Reading image files into texels."""

import io
import warnings

import numpy as np

from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.model import Image

LARGEST = 8192 * 8192
"""Texels; a larger image is refused before it is unpacked."""

_SIGNATURES = {
    b"\xabKTX 20\xbb": "KTX2",
    b"\xabKTX 11\xbb": "KTX",
    b"DDS ": "DDS",
    b"GIF8": "GIF",
    b"BM": "BMP",
    b"II*\0": "TIFF",
    b"MM\0*": "TIFF",
    b"\x76\x2f\x31\x01": "OpenEXR",
    b"#?RADIANCE": "Radiance HDR",
}


def read_image(data: bytes, name: str, where: str) -> Image:
    """The texels of a PNG or JPEG file: (H, W, 3) or, where the file has transparency, (H, W, 4).

    Eight bits a channel stay uint8; a 16-bit grey image becomes float32 in 0…1. Grey is repeated in all three
    colours. Colour profiles and orientation tags are ignored, as glTF asks.

    Args:
        data: the file's content.
        name: kept in the image.
        where: what names the image, for messages.

    Raises:
        SceneError: it is damaged, too large, or in another format.
    """
    from PIL import Image as Picture

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # our own limit is below PIL's
            with Picture.open(io.BytesIO(data), formats=("PNG", "JPEG")) as picture:
                width, height = picture.size
                if width * height > LARGEST:
                    raise SceneError(
                        "the image is too large",
                        where=where,
                        expected=f"at most {LARGEST} texels (8192 × 8192)",
                        actual=f"{width} × {height}",
                        remedy="scale it down",
                    )
                texels = _texels(picture)
    except SceneError:
        raise
    except Exception as error:  # PIL's decoders raise OSError, SyntaxError, struct.error, zlib.error, …
        reason = type(error).__name__ if "<" in str(error) else f"{type(error).__name__}: {str(error)[:120]}"
        raise SceneError(
            f"the image cannot be read ({reason})",
            where=where,
            expected="an undamaged PNG or JPEG file",
            actual=_format(data),
        ) from None
    return Image(texels, name)


def _texels(picture) -> np.ndarray:
    if picture.mode.startswith("I"):  # 16-bit grey
        grey = np.asarray(picture, dtype=np.float32) / 65535
        return np.repeat(grey[:, :, None], 3, axis=2)
    see_through = picture.mode in ("RGBA", "LA", "PA", "La", "RGBa") or "transparency" in picture.info
    return np.asarray(picture.convert("RGBA" if see_through else "RGB"), dtype=np.uint8)


def _format(data: bytes) -> str:
    if data[:4] == b"RIFF" and data[8:12] == b"WEBP":
        return "a WebP file"
    for signature, name in _SIGNATURES.items():
        if data.startswith(signature):
            return f"a {name} file"
    return f"{len(data)} bytes" + (f" that begin with {data[:8].hex(' ')}" if data else "")
