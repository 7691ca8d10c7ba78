"""Texture lookup: level 0, bilinear (or nearest), with glTF's wrapping.

The arithmetic is generic: a grid's numbers may be plain (one texture) or arrays (a texture per point), and the texels
may lie in a NumPy array or a Dr.Jit one. Colour textures are decoded to linear light before filtering, as glTF asks
(3.8.2).
"""

from dataclasses import dataclass

import numpy as np

from ..model import Texture
from . import arrays as xp
from .arrays import Array
from .color import srgb_decode

REPEAT, CLAMP, MIRROR = 0, 1, 2
WRAP_CODES = {"repeat": REPEAT, "clamp": CLAMP, "mirror": MIRROR}


def linear_texels(texture: Texture) -> np.ndarray:
    """(H, W, 4) float32 linear texels: grey is spread to RGB, alpha is 1 where the image has none."""
    texels = texture.image.texels
    channels = texels.shape[2]
    color = texels[..., :3] if channels >= 3 else np.repeat(texels[..., :1], 3, axis=2)
    out = np.ones((*texels.shape[:2], 4), np.float32)
    if texels.dtype == np.uint8:
        codes = np.arange(256) / 255
        out[..., :3] = (srgb_decode(codes) if texture.srgb else codes).astype(np.float32)[color]
    else:
        out[..., :3] = srgb_decode(color.astype(np.float64)) if texture.srgb else color
    if channels in (2, 4):
        alpha = texels[..., -1]
        out[..., 3] = alpha / np.float64(255) if texels.dtype == np.uint8 else alpha
    return out


@dataclass(frozen=True)
class TexelGrid:
    """How texture coordinates become texels: size, wrapping (see `WRAP_CODES`), filter and transform.

    Attributes:
        nearest: 1 where the nearest texel is taken, 0 where four are mixed.
        matrix: the six numbers of `Texture.matrix`, row by row.
    """

    width: Array
    height: Array
    wrap_u: Array
    wrap_v: Array
    nearest: Array
    matrix: tuple[Array, ...]

    @classmethod
    def of(cls, texture: Texture) -> "TexelGrid":
        """The grid of one texture, as plain numbers."""
        height, width = texture.image.texels.shape[:2]
        return cls(
            float(width),
            float(height),
            WRAP_CODES[texture.wrap_u],
            WRAP_CODES[texture.wrap_v],
            int(texture.mag_filter == "nearest"),
            tuple(float(x) for x in texture.matrix.ravel()),
        )

    def taps(self, u: Array, v: Array) -> list[tuple[Array, Array, Array]]:
        """Four (column, row, weight); columns and rows are whole numbers in floating point, within the image."""
        a, b, c, d, e, f = self.matrix
        x = (a * u + b * v + c) * self.width - 0.5
        y = (d * u + e * v + f) * self.height - 0.5
        x0, y0 = xp.floor(x), xp.floor(y)
        # Nearest is bilinear with the fraction rounded: all the weight falls on the closest texel.
        fx = xp.where(self.nearest == 1, xp.floor(x - x0 + 0.5), x - x0)
        fy = xp.where(self.nearest == 1, xp.floor(y - y0 + 0.5), y - y0)
        left, right = (wrap_texel(i, self.width, self.wrap_u) for i in (x0, x0 + 1))
        top, bottom = (wrap_texel(i, self.height, self.wrap_v) for i in (y0, y0 + 1))
        return [
            (left, top, (1 - fx) * (1 - fy)),
            (right, top, fx * (1 - fy)),
            (left, bottom, (1 - fx) * fy),
            (right, bottom, fx * fy),
        ]


def wrap_texel(index: Array, size: Array, wrap: Array) -> Array:
    """A whole texel number (in floating point, any sign) brought into 0…size − 1."""
    period = xp.where(wrap == MIRROR, 2 * size, size)
    folded = index - period * xp.floor(index / period)
    folded = xp.where(wrap == MIRROR, xp.minimum(folded, 2 * size - 1 - folded), folded)
    # The clip also catches what rounding of index / period may leave a texel outside.
    return xp.clip(xp.where(wrap == CLAMP, index, folded), 0.0, size - 1)


def look_up(texture: Texture, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """(4, N) float64 linear RGBA at texture coordinates u, v (N,)."""
    texels = linear_texels(texture)
    total = np.zeros((4, len(u)))
    for column, row, weight in TexelGrid.of(texture).taps(u, v):
        total += weight * texels[row.astype(np.int64), column.astype(np.int64)].T
    return total
