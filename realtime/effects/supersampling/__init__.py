"""Coverage by n × n samples on a regular grid in the pixel; one is the centre sample."""

import numpy as np

from ...effect import Effect, Knob, Knobs


def offsets(knobs: Knobs) -> np.ndarray:
    """(n², 2) float64 offsets from the pixel's centre, pixels right and down."""
    n = int(knobs["grid"])
    steps = (np.arange(n) + 0.5) / n - 0.5
    return np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)


EFFECT = Effect(
    name="supersampling",
    terms=("coverage",),
    summary="The frame is drawn once per sample of a regular grid in the pixel and averaged, scene-linear.",
    citation="Haeberli & Akeley 1990, The Accumulation Buffer, section 3",
    knobs=(
        Knob(
            "grid",
            1,
            "Samples along each side of the pixel; 1 is the centre sample and costs nothing.",
            unit="samples",
            low=1,
            high=16,
            sweep=(1, 2, 4, 8),
        ),
    ),
    offsets=offsets,
)
