"""The knobs that shadow techniques share."""

from dataclasses import replace

from ..effect import Knob

RESOLUTION = Knob(
    "resolution",
    1024,
    "Side of the map, or of each of a cube's six faces.",
    unit="texels",
    low=16,
    high=8192,
    sweep=(128, 256, 512, 1024, 2048, 4096),
)
NORMAL_OFFSET = Knob(
    "normal_offset",
    0.0,
    "How far a point is moved along its normal, times the sine of the light's angle to it.",
    unit="texels",
    low=0.0,
    high=32.0,
    sweep=(0.0, 1.0, 2.0),
)
FACES = Knob(
    "faces",
    "both",
    "Which faces cast: those towards the light, those away from it (its own front then shadows nothing), or both; "
    "double-sided shapes cast with both.",
    choices=("both", "front", "back"),
    sweep=("both", "front", "back"),
)
FILTER = Knob(
    "filter",
    "pcf3",
    "One comparison; the mean of 3 × 3 to 9 × 9 neighbouring ones; or of some in a disk that is turned at every pixel.",
    choices=("hard", "pcf3", "pcf5", "pcf7", "pcf9", "poisson"),
    sweep=("hard", "pcf3", "pcf5", "pcf9", "poisson"),
)
RADIUS = Knob("radius", 2.0, "The disk's radius, for filter=poisson.", unit="texels", low=0.5, high=32.0)
SAMPLES = Knob("samples", 16, "Comparisons within the disk, for filter=poisson.", low=1, high=64)
BLUR = Knob(
    "blur",
    1,
    "How many texels on either side the map is averaged over, before it is looked up: 1 is 3 × 3.",
    unit="texels",
    low=0,
    high=16,
    sweep=(0, 1, 2, 4),
)
BLEEDING = Knob(
    "bleeding",
    0.0,
    "Visibilities up to this are taken for dark and the others spread: less light leaks, edges shift.",
    low=0.0,
    high=0.99,
    sweep=(0.0, 0.1, 0.2, 0.4, 0.6),
)

COMPARING = (FILTER, RADIUS, SAMPLES)


def biases(constant: float = 0.5, slope: float = 1.0) -> tuple[Knob, ...]:
    """What keeps a surface from shadowing itself, with a technique's defaults."""
    bias = Knob(
        "bias",
        constant,
        "How far a point is moved towards the light before it is compared.",
        unit="texels",
        low=0.0,
        high=100.0,
        sweep=(0.0, 0.5, 1.0, 2.0),
    )
    slope_bias = Knob(
        "slope_bias",
        slope,
        "The same, times the slope against the light and the filter's radius.",
        low=0.0,
        high=100.0,
        sweep=(0.0, 0.5, 1.0, 2.0),
    )
    return bias, slope_bias, NORMAL_OFFSET, FACES


def with_default(knob: Knob, value) -> Knob:
    """The same knob with another default."""
    return replace(knob, default=value)
