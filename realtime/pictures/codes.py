"""Code values written to 8 bits, rounded or dithered."""

from typing import Any

import numpy as np

from ..effect import Knob, Knobs
from ..shadows.twin import noise

DITHER = Knob(
    "dither",
    "none",
    "What is added before rounding to 8 bits: nothing, thresholds of an 8 × 8 pattern, or interleaved gradient noise.",
    choices=("none", "ordered", "noise"),
    sweep=("none", "ordered", "noise"),
)


def dither_defines(knobs: Knobs) -> dict[str, Any]:
    """What the pass that writes the codes is compiled with."""
    thresholds = {"ordered": "ordered_threshold(pixel)", "noise": "interleaved_noise(pixel)"}
    return {"DITHER": thresholds.get(str(knobs["dither"]))}


def ordered_threshold(pixel: np.ndarray) -> np.ndarray:
    """0…1 at whole (2, …) places, right and up from the picture's lower left corner (Bayer 1973)."""
    x, y = np.asarray(pixel).astype(int) & 7
    q = x ^ y
    rank = (q & 1) << 5 | (y & 1) << 4 | (q & 2) << 2 | (y & 2) << 1 | (q & 4) >> 1 | (y & 4) >> 2
    return (rank + 0.5) / 64


def written(codes: np.ndarray, knobs: Knobs) -> np.ndarray:
    """(H, W, 3) code values 0…1 as they are after 8 bits; row 0 is the picture's top."""
    height, width = codes.shape[:2]
    pixel = np.stack(np.meshgrid(np.arange(width), np.arange(height)[::-1]))
    threshold = {
        "ordered": ordered_threshold,
        "noise": lambda place: noise(place.astype(np.float64)),
        "none": lambda _place: np.full((height, width), 0.5),
    }[str(knobs["dither"])](pixel)
    return np.rint(np.clip(codes, 0.0, 1.0) * 255 + (threshold - 0.5)[..., None]) / 255
