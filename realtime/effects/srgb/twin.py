"""Float64 twin of srgb.glsl, and of the encoding curve that it shares."""

import numpy as np

from lightmeter.scenes.optics import color

from ...effect import Knobs
from ...twin import Argument, Twin, logarithmic


def srgb_encode(linear: np.ndarray) -> np.ndarray:
    """Code values 0…1 from display-linear light, clipped (IEC 61966-2-1)."""
    return color.srgb_encode(np.clip(linear, 0.0, 1.0))


def encode(linear: np.ndarray, _knobs: Knobs) -> np.ndarray:
    """The effect as a whole: (…, 3) display-linear to code values."""
    return srgb_encode(linear)


TWINS = (
    Twin(
        "srgb_curve.glsl",
        "srgb_encode",
        "vec3",
        (
            Argument(
                "linear",
                "vec3",
                logarithmic(1e-6, 2.0, 3),
                ((0.0, -1.0, 1.0), (0.0031308, 0.00313, 0.00314), (2.0, 1e30, 0.5)),
            ),
        ),
        srgb_encode,
        roundings=18 + 2 + 1,
        why="pow above 0.0031 by GLSL's specification (4.7.1, in ulp): log2 3 ulp of 8.3 (24 eps) times ln 2/2.4, "
        "exp2 3 + 2·3.5, the product between: 18; llvmpipe (Mesa 22.3) errs by 6.3. Then 1.055 and 0.055; one for the "
        "exponent's own rounding",
    ),
)
