"""Multisampling of a deferred frame: pixels that several triangles share are lit at each sample, the others once."""

import numpy as np

from ...effect import Effect, Knob, Knobs

PATTERNS = {
    2: ((4, 4), (-4, -4)),
    4: ((-2, -6), (6, -2), (-6, 2), (2, 6)),
    8: ((1, -3), (-1, 3), (5, 1), (-3, -5), (-5, 5), (-7, -1), (3, 7), (7, -7)),
}
"""Sixteenths of a pixel right and down: Direct3D 11's standard patterns; no two samples share a row or a column."""


def offsets(knobs: Knobs) -> np.ndarray:
    """(1 + samples, 2) float64 offsets from the pixel's centre, pixels right and down; the centre comes first."""
    return np.array([(0, 0), *PATTERNS[int(knobs["samples"])]]) / 16


EFFECT = Effect(
    name="msaa",
    terms=("coverage",),
    summary="The samples of a rotated grid are lit one by one where they see more than one triangle; elsewhere the "
    "pixel's centre is lit alone.",
    citation="Akeley 1993, RealityEngine Graphics; deferred: Lauritzen 2010, Deferred Rendering for Current and Future "
    "Rendering Pipelines, SIGGRAPH course",
    knobs=(Knob("samples", 4, "Samples in the pixel.", unit="samples", choices=(2, 4, 8), sweep=(2, 4, 8)),),
    rank=1,
    masks=True,
    offsets=offsets,
)
