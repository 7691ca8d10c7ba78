"""Float64 twins of the shaders that passes over pictures share."""

from lightmeter.scenes.optics.material import luminance

from ..twin import Argument, Twin, logarithmic, whole
from .blocks import bright_part
from .codes import ordered_threshold

COLOR = Argument("color", "vec3", logarithmic(1e-6, 1e6, 3), ((0.0, 0.0, 0.0), (1.0, 1.0, 1.0), (0.0, 1e4, 0.18)))

TWINS = (
    Twin(
        "dither.glsl",
        "ordered_threshold",
        "float",
        (Argument("pixel", "vec2", lambda rng, n: whole(0, 4095)(rng, 2 * n).reshape(2, n)),),
        ordered_threshold,
        roundings=0,
        why="whole numbers over 64",
    ),
    Twin(
        "luminance.glsl", "luminance", "float", (COLOR,), luminance, roundings=1 + 3, why="a constant; products, sums"
    ),
    Twin(
        "bright_part.glsl",
        "bright_part",
        "vec3",
        (COLOR, Argument("threshold", "float", logarithmic(1e-3, 1e3), (0.0, 1.0))),
        bright_part,
        guards=("1e-20",),
        roundings=4 + 1 + 2.5 + 1,
        why="the luminance (4), less the threshold, over the luminance (2.5), times the colour",
    ),
)
