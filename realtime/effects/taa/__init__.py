"""Temporal anti-aliasing: every frame is sampled elsewhere in the pixel, and blended with those before it."""

import numpy as np

from ...effect import Effect, Knob, Knobs


def offsets(knobs: Knobs) -> np.ndarray:
    """(frames, 2) float64 offsets from the pixel's centre, right and down: Halton's sequence in bases 2 and 3."""
    places = [[_radical_inverse(frame, base) for base in (2, 3)] for frame in range(1, int(knobs["frames"]) + 1)]
    return np.array(places) - 0.5


def _radical_inverse(number: int, base: int) -> float:
    """A number's digits, mirrored at the point: in 0…1 (Halton 1960)."""
    value, digit = 0.0, 1.0
    while number:
        number, rest = divmod(number, base)
        digit /= base
        value += rest * digit
    return value


EFFECT = Effect(
    name="taa",
    terms=("coverage",),
    summary="Frames of a camera that stands still, each sampled elsewhere in the pixel and blended with the "
    "history of those before, which is clamped to the colours around the pixel.",
    citation="Karis 2014, High-Quality Temporal Supersampling, SIGGRAPH course",
    knobs=(
        Knob(
            "frames",
            16,
            "Frames since the camera has stood still; a frame costs one of them.",
            unit="frames",
            low=1,
            high=16,
            sweep=(1, 2, 4, 8, 16),
        ),
        Knob(
            "blend",
            0.1,
            "Least share of a new frame in what is shown; it has more as long as there are few. At 0 all count alike.",
            low=0.0,
            high=1.0,
            sweep=(0.0, 0.05, 0.1, 0.2, 0.5),
        ),
        Knob("clamp", True, "Whether the history is clamped to the box of the 3 × 3 new colours around it, in YCoCg."),
        Knob(
            "weigh",
            False,
            "Whether colours are weighted with 1/(1 + exposed luma), so that a highlight counts less.",
        ),
    ),
    rank=2,
    stage="radiance",
    offsets=offsets,
)
