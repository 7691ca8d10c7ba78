"""Screen-space ambient occlusion as most tutorials have it: samples in a hemisphere, compared with the depth shown."""

from ...ambient.knobs import CHANNELS, RESOLUTION, SPECULAR_OCCLUSION, denoise, radius, specular_defines
from ...effect import Effect, Knob

EFFECT = Effect(
    name="ssao",
    terms=("environment_visibility",),
    summary="Of some places in a hemisphere above each point, the share that lies behind what the screen shows there.",
    citation="Mittring 2007, Finding Next Gen: CryEngine 2; Chapman 2011, SSAO Tutorial; de Vries 2015, Learn OpenGL: "
    "SSAO (kernel, 4 × 4 rotations, range check, box blur)",
    knobs=(
        Knob("samples", 64, "Places in the hemisphere.", low=1, high=128, sweep=(8, 16, 32, 64, 128)),
        radius(0.5),
        Knob(
            "bias",
            0.025,
            "What is shown has to lie this much nearer to the viewer than a place, to hide it: less, and a surface "
            "hides itself.",
            unit="m",
            low=0.0,
            high=10.0,
            sweep=(0.0, 0.01, 0.025, 0.05, 0.1),
        ),
        Knob("power", 1.0, "The visibility's exponent: above 1 darker.", low=0.1, high=8.0, sweep=(0.5, 1.0, 2.0, 3.0)),
        denoise("box4"),
        RESOLUTION,
        SPECULAR_OCCLUSION,
    ),
    rank=2,
    optional=True,
    channels=CHANNELS,
    defines=specular_defines,
)
