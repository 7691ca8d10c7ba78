"""The frame's own display transform as a curve that a browser can apply."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class DisplayCurve:
    """Scene-linear value to display value, per channel.

    Attributes:
        log2_input: increasing log2 of scene-linear values, the frame's own exposure not yet applied.
        display: display code values in [0, 1], one per input. Below the first input the curve runs straight to 0.
        name: what it is called in the report ("Narkowicz, sRGB").
    """

    log2_input: tuple[float, ...]
    display: tuple[float, ...]
    name: str = "as the frame's"

    def __post_init__(self) -> None:
        x, y = (np.asarray(values, np.float64) for values in (self.log2_input, self.display))
        if x.ndim != 1 or x.shape != y.shape or x.size < 2:
            raise ValueError(f"display curve: expected two lists of one length ≥ 2, found {x.shape} and {y.shape}")
        if not (np.isfinite(x).all() and np.isfinite(y).all() and (np.diff(x) > 0).all()):
            raise ValueError("display curve: expected finite values and increasing inputs")
        object.__setattr__(self, "log2_input", tuple(x.tolist()))
        object.__setattr__(self, "display", tuple(y.tolist()))

    def apply(self, image: np.ndarray) -> np.ndarray:
        """Display values of a scene-linear array of any shape; what is not finite or below 0 becomes 0."""
        x, y = np.array(self.log2_input), np.array(self.display)
        value = np.where(np.isfinite(image) & (image > 0), image, 0.0)
        with np.errstate(divide="ignore"):
            shown = np.interp(np.log2(value), x, y)
        first = 2.0 ** x[0]
        return np.where(value < first, y[0] * value / first, shown)


def srgb_curve() -> DisplayCurve:
    """Clipping at 1 and the sRGB curve, as a `DisplayCurve`."""
    x = np.linspace(-14, 0, 256)
    value = 2.0**x
    y = np.where(value <= 0.0031308, 12.92 * value, 1.055 * value ** (1 / 2.4) - 0.055)
    return DisplayCurve(tuple(x), tuple(y), "sRGB")
