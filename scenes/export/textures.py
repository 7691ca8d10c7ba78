"""Textures, samplers and PNG images (glTF 2.0, sections 3.8 and 3.9; KHR_texture_transform)."""

import io
import re
from pathlib import PurePosixPath
from typing import Any

import numpy as np

from ..errors import SceneError, shown
from ..gltf.textures import MIN_FILTERS, WRAPS
from ..model import Image, Texture

TRANSFORM = "KHR_texture_transform"
WRAP_CODES = {name: code for code, name in WRAPS.items()}
MIN_FILTER_CODES = {name: code for code, name in MIN_FILTERS.items() if code is not None}
MAG_FILTER_CODES = {"nearest": 9728, "linear": 9729}


class Textures:
    """The textures of one file; each image, sampler and texture is written once.

    Attributes:
        images, samplers, textures: glTF's arrays.
        files: the PNG files, by their path relative to the glTF.
        notes: what an engine may not see as it is here.
        extensions: which extensions were used.
    """

    def __init__(self):
        self.images: list[dict[str, Any]] = []
        self.samplers: list[dict[str, Any]] = []
        self.textures: list[dict[str, Any]] = []
        self.files: dict[str, bytes] = {}
        self.notes: list[str] = []
        self.extensions: set[str] = set()
        self._numbers: dict[Image, int] = {}

    def info(self, texture: Texture) -> dict[str, Any]:
        """What a material says of a texture: its number, its texture coordinates, its transform.

        Raises:
            SceneError: PNG cannot hold its texels.
        """
        sampler = {
            "magFilter": MAG_FILTER_CODES[texture.mag_filter],
            "minFilter": MIN_FILTER_CODES[texture.min_filter],
            "wrapS": WRAP_CODES[texture.wrap_u],
            "wrapT": WRAP_CODES[texture.wrap_v],
        }
        entry = {"sampler": _number(self.samplers, sampler), "source": self._image(texture.image)}
        info: dict[str, Any] = {"index": _number(self.textures, entry), "texCoord": texture.texcoord}
        transform = {"offset": list(texture.offset), "rotation": texture.rotation, "scale": list(texture.scale)}
        if transform != {"offset": [0, 0], "rotation": 0, "scale": [1, 1]}:
            info["extensions"] = {TRANSFORM: transform}
            self.extensions.add(TRANSFORM)
        return info

    def _image(self, image: Image) -> int:
        if image not in self._numbers:
            number = self._numbers[image] = len(self.images)
            words = re.sub(r"[^A-Za-z0-9_-]+", "-", PurePosixPath(image.name).stem)[:40].strip("-")
            uri = f"textures/{number}-{words or 'image'}.png"
            texels = image.texels
            if texels.dtype != np.uint8:
                texels = _sixteen_bits(image)
                self.notes.append(
                    f"{uri} has 16 bits: an engine that decodes PNG to 8 bits rounds its values to steps of 1/255"
                )
            self.images.append({"name": image.name, "uri": uri, "mimeType": "image/png"})
            self.files[uri] = _png(texels)
        return self._numbers[image]


def _number(items: list[dict[str, Any]], item: dict[str, Any]) -> int:
    """Where `item` stands in `items`, appended if it is not there."""
    if item not in items:
        items.append(item)
    return items.index(item)


def _sixteen_bits(image: Image) -> np.ndarray:
    """(H, W, 1) uint16 whose 65535th part are the texels, exactly.

    Raises:
        SceneError: there are none.
    """
    grey = image.texels[..., :1]
    alpha = image.texels.shape[2] in (2, 4)
    if not alpha and (image.texels == grey).all() and grey.min(initial=0) >= 0 and grey.max(initial=0) <= 1:
        codes = np.rint(grey * np.float32(65535))
        if (codes / np.float32(65535) == grey).all():
            return codes.astype(np.uint16)
    raise SceneError(
        f"the image {shown(image.name)} cannot be exported: glTF has PNG, which has whole numbers",
        expected="8 bits a channel, or grey in 16 bits",
        actual="floating point",
        remedy="round its texels to uint8",
    )


def _png(texels: np.ndarray) -> bytes:
    """A PNG file of (H, W, C) uint8, or of (H, W, 1) uint16: grey, grey and alpha, RGB, or RGBA."""
    from PIL import Image as Picture

    out = io.BytesIO()
    # The fastest level: photographs grow by a tenth, and are written in a fifth of the time.
    Picture.fromarray(texels[..., 0] if texels.shape[2] == 1 else texels).save(out, "PNG", compress_level=1)
    return out.getvalue()
