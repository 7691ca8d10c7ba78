"""What values may have been through on their way into a file, and back."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np


def srgb_encode(light: np.ndarray) -> np.ndarray:
    """Linear light of any shape to code values by IEC 61966-2-1's curve, carried on above 1; values below 0 are 0."""
    light = np.maximum(light, 0.0)
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)


def srgb_decode(code: np.ndarray) -> np.ndarray:
    """Code values of any shape to linear light: the inverse of `srgb_encode`."""
    code = np.maximum(code, 0.0)
    return np.where(code <= 0.04045, code / 12.92, ((code + 0.055) / 1.055) ** 2.4)


@dataclass(frozen=True)
class Curve:
    """A curve that values went through once too often.

    Attributes:
        exponent: of the power law; of the sRGB curve and its inverse, that of the usual short cut for it.
        srgb: whether it is the sRGB curve (exponent below 1) or its inverse (above 1).
        undo: gives back the values before it.
    """

    exponent: float
    srgb: bool
    undo: Callable[[np.ndarray], np.ndarray]

    @classmethod
    def of(cls, exponent: float, srgb: bool) -> Curve:
        """The curve of that exponent."""
        if srgb:
            return SRGB[0] if exponent < 1 else SRGB[1]
        return cls(exponent, False, lambda values: np.maximum(values, 0.0) ** (1 / exponent))


SRGB = Curve(1 / 2.2, True, srgb_decode), Curve(2.2, True, srgb_encode)
"""The curve, and its inverse (Poynton 1998, "The Rehabilitation of Gamma": about a power law of 2.2)."""
