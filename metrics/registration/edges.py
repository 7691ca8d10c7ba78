"""Where an image's edges lie, whatever their contrast: what tells a shifted image from a differently lit one.

Gradients of the logarithm do not change with exposure, and with an exponent only in length; divided by their own
length where they are longer than a floor, they say where there is an edge and how it runs, and no more. Two renderers
that light a scene differently still agree on that. The floor rises with the reference's noise, on both sides alike, so
that noise is no edge.
"""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter, gaussian_filter1d

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
"""Of linear Rec. 709 (ITU-R BT.709)."""
_DARK = 0.1  # of the typical luminance, added before the logarithm: what is darker has no contrast
_FAINT = 0.15  # change of the logarithm over a pixel that counts as half an edge
_SIGMAS = 3.0  # of the gradient's noise, likewise
_BRIGHT = 20.0  # times the typical luminance: the rest of a firefly or a highlight is cut off
_NEIGHBOURHOOD = 2.0  # pixels over which the noise is averaged


@dataclass(frozen=True, eq=False)
class Gradients:
    """Gradients of the logarithm of an image.

    Attributes:
        down, right: (H, W) per pixel.
        noise: (H, W) or 0, the variance of either that the image's noise makes.
    """

    down: np.ndarray
    right: np.ndarray
    noise: np.ndarray | float

    @property
    def squared(self) -> np.ndarray:
        """(H, W): their squared length."""
        return self.down**2 + self.right**2


def gradients(light: np.ndarray, blur: float, variance: np.ndarray | None = None) -> Gradients:
    """Gradients of the logarithm of a blurred image.

    White noise of variance v, blurred by σ, has a derivative of variance v/(8πσ⁴).

    Args:
        light: (H, W) luminance, finite, not negative; any exposure.
        blur: σ in pixels of the Gaussian.
        variance: (H, W) of the luminance's noise; None: it has none.
    """
    typical = float(np.mean(np.minimum(light, np.percentile(light, 95)))) or float(light.mean())
    if not typical > 0:
        return Gradients(np.zeros(light.shape), np.zeros(light.shape), 0.0)
    relative = np.minimum(light / typical, _BRIGHT)
    level = _DARK + gaussian_filter(relative, blur)
    down = gaussian_filter1d(gaussian_filter1d(relative, blur, axis=0, order=1), blur, axis=1) / level
    right = gaussian_filter1d(gaussian_filter1d(relative, blur, axis=1, order=1), blur, axis=0) / level
    noise: np.ndarray | float = 0.0
    if variance is not None:
        spread = gaussian_filter(variance, _NEIGHBOURHOOD) / typical**2
        noise = spread / gaussian_filter(level, _NEIGHBOURHOOD) ** 2 / (8 * np.pi * blur**4)
    return Gradients(down, right, noise)


def tensors(one: Gradients, other: Gradients) -> tuple[np.ndarray, np.ndarray]:
    """Where edges are and how they run, without the side that is brighter: (3, H, W) each.

    The gradient's outer product with itself (the structure tensor before its blur: Förstner & Gülch 1987) over its
    trace, less what noise adds. A ridge along every edge: an edge that the other image lacks (a shadow that is not
    drawn) pulls an alignment to neither side.
    """
    floor = _floor(one, other)

    def of(image: Gradients) -> np.ndarray:
        across, diagonal, along = image.right**2 - image.noise, image.right * image.down, image.down**2 - image.noise
        return np.stack([across, np.sqrt(2.0) * diagonal, along]) / (image.squared + floor)

    return of(one), of(other)


def directions(one: Gradients, other: Gradients) -> tuple[np.ndarray, np.ndarray]:
    """Where images grow brighter, by their direction: (2, H, W) each, at most 1 long."""
    floor = _floor(one, other)
    one_, other_ = (np.stack([i.right, i.down]) / np.sqrt(i.squared + floor) for i in (one, other))
    return one_, other_


def _floor(one: Gradients, other: Gradients) -> np.ndarray | float:
    return _FAINT**2 + 2 * _SIGMAS**2 * (one.noise + other.noise)
