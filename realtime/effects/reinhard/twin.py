"""Float64 twin of reinhard.glsl."""

import numpy as np

from lightmeter.scenes.optics.color import LUMINANCE

from ...effect import Knobs
from ...twin import Argument, Twin, logarithmic


def reinhard(x: np.ndarray, brightest: float | np.ndarray) -> np.ndarray:
    """The curve (Reinhard et al. 2002, eq. 4)."""
    return x * (1 + x / brightest**2) / (1 + x)


def tone(radiance: np.ndarray, knobs: Knobs) -> np.ndarray:
    """The effect as a whole: (…, 3) scene-linear to display-linear."""
    x, white = np.clip(radiance * float(knobs["prescale"]), 0.0, 1e9), float(knobs["white"])
    if knobs["on"] == "channels":
        return np.minimum(reinhard(x, white), 1.0)
    y = x @ np.array(LUMINANCE, x.dtype)
    return np.clip(x * (reinhard(y, white) / np.maximum(y, 1e-20))[..., None], 0.0, 1.0)


TWINS = (
    Twin(
        "reinhard.glsl",
        "reinhard",
        "vec3",
        (
            Argument("x", "vec3", logarithmic(1e-6, 1e6, 3), ((0.0, 0.0, 1e8), (1.0, 1e4, 0.18))),
            Argument("brightest", "float", logarithmic(0.1, 1e6), (1.0, 4.0)),
        ),
        reinhard,
        roundings=1 + 2.5 + 1 + 1 + 1 + 2.5,
        why="the square, two divisions (2.5 each), two sums, a product",
    ),
)
