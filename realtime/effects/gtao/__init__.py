"""Ground-truth ambient occlusion: horizons in the depth shown, integrated in closed form slice by slice."""

from ...ambient.knobs import CHANNELS, RESOLUTION, SPECULAR_OCCLUSION, denoise, radius, specular_defines
from ...effect import Effect, Knob, Knobs


def defines(knobs: Knobs) -> dict[str, object]:
    """What is compiled in."""
    return specular_defines(knobs) | {"MULTI_BOUNCE": bool(knobs["multi_bounce"])}


EFFECT = Effect(
    name="gtao",
    terms=("environment_visibility",),
    summary="In slices through the direction to the viewer, what lies below the highest shown horizon is hidden; what "
    "is above is integrated in closed form.",
    citation="Jimenez, Wu, Pesce & Jarabo 2016, Practical Realtime Strategies for Accurate Indirect Occlusion (eq. "
    "5-10; noise of 4 × 4 pixels, thickness heuristic, bent normal); Intel 2021, XeGTAO (falloff)",
    knobs=(
        Knob("slices", 3, "Directions on the screen.", low=1, high=64, sweep=(1, 2, 3, 6, 12)),
        Knob(
            "steps", 6, "Places on each side of a slice, nearer ones closer.", low=1, high=128, sweep=(2, 4, 6, 12, 24)
        ),
        radius(1.0),
        Knob(
            "falloff",
            0.6,
            "The last share of the radius, over which occluders fade.",
            low=0.0,
            high=1.0,
            sweep=(0.0, 0.3, 0.6, 1.0),
        ),
        Knob(
            "thickness",
            0.0,
            "How far the horizon falls back at each place that lies below it: 0, and everything is infinitely thick.",
            low=0.0,
            high=1.0,
            sweep=(0.0, 0.05, 0.1, 0.2, 0.4),
        ),
        Knob(
            "multi_bounce",
            False,
            "Brighter by what light between surfaces of one albedo gives back (eq. 10). The term does not hold "
            "that light: it is `indirect`.",
        ),
        denoise("bilateral"),
        RESOLUTION,
        SPECULAR_OCCLUSION,
    ),
    rank=1,
    optional=True,
    channels=CHANNELS,
    defines=defines,
)
