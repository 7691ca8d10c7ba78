"""Exponential shadow maps: the comparison of depths as an exponential, filtered before it is known what is compared."""

from ...effect import Effect, Knob
from ...shadows.knobs import BLUR, RESOLUTION, biases, with_default

EFFECT = Effect(
    name="exponential_shadow_map",
    terms=("visibility",),
    summary="The exponential of the depth is averaged like a picture; over that of a point it is a visibility.",
    citation="Annen, Mertens, Seidel, Flerackers & Kautz 2008, Exponential Shadow Maps, eq. 6",
    knobs=(
        with_default(RESOLUTION, 512),
        BLUR,
        Knob(
            "exponent",
            80.0,
            "How fast light fades behind a blocker: by e over this part of the scene's depth as the light sees it. At "
            "more than 80 it would overflow.",
            low=1.0,
            high=80.0,
            sweep=(10.0, 20.0, 40.0, 80.0),
        ),
        *biases(0.0, 0.0),
    ),
    rank=1,
    channels=("position", "normal"),
)
