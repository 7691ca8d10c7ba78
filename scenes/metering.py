"""Automatic exposure: the rule that says how bright a picture is, and what it is brought to."""

from dataclasses import dataclass

import numpy as np

from .optics.color import LUMINANCE


@dataclass(frozen=True)
class Metering:
    """How the camera meters: a log-average of luminance, as Reinhard et al. 2002 (eq. 1), trimmed at both ends.

    Attributes:
        grey: what the average is brought to; 1 is diffuse white.
        darkest, brightest: the shares of the pixels that do not count, in [0, 1), less than 1 together.
        floor: luminance below which a pixel counts as this, W/(sr·m²).
    """

    grey: float = 0.18
    darkest: float = 0.0
    brightest: float = 0.0
    floor: float = 1e-4

    def average(self, image: np.ndarray) -> float:
        """The log₂ of the average luminance, exactly: each pixel's by the part of it that lies between the trims.

        Args:
            image: (H, W, 3) scene-linear; pixels that are not finite do not count.
        """
        luminance = np.asarray(image, np.float64).reshape(-1, 3) @ LUMINANCE
        stops = np.sort(np.log2(np.maximum(luminance[np.isfinite(luminance)], self.floor)))
        if not len(stops):
            return float(np.log2(self.floor))
        edges = np.clip(np.arange(len(stops) + 1) / len(stops), self.darkest, 1 - self.brightest)
        return float(np.average(stops, weights=np.diff(edges)))

    def scale(self, average: float) -> float:
        """The exposure, a factor, for a log₂ of an average luminance."""
        return self.grey * 2.0**-average
