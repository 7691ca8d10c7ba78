"""Colour differences: ΔE2000 of display images and ΔE_ITP of scene-linear ones, with colour-science.

ΔE2000: CIE 142-2001; Sharma, Wu, Dalal, "The CIEDE2000 Color-Difference Formula", Color Research & Application 2005.
ΔE_ITP: Recommendation ITU-R BT.2124-0 (2019), on ICtCp of BT.2100.
"""

import warnings
from collections.abc import Callable

import numpy as np

from .comparison import Comparison
from .input_error import InputError
from .measurement import Measurement
from .noisy_mean import ErrorMap, measure_map

# BT.2408's reference white for HDR: what a scene-linear 1 is shown at unless stated.
REFERENCE_WHITE = 203.0
_PQ_PEAK = 10000.0  # cd/m², the largest luminance that PQ encodes


def delta_e_2000_map(tested: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """ΔE2000 per pixel of two sRGB-encoded images.

    Args:
        tested: (H, W, 3) in [0, 1], clamped.
        reference: the same.

    Returns:
        (H, W) float64, 0 is equal, about 1 just noticeable.
    """
    colour = _colour()
    space = colour.RGB_COLOURSPACES["sRGB"]

    def lab(encoded: np.ndarray) -> np.ndarray:
        linear = colour.models.eotf_sRGB(np.clip(np.asarray(encoded, np.float64), 0, 1))
        # White from the matrix itself, so that equal channels are exactly neutral.
        matrix = space.matrix_RGB_to_XYZ
        xyz = linear @ matrix.T
        return colour.XYZ_to_Lab(xyz, colour.XYZ_to_xy(matrix.sum(axis=1)))

    return np.asarray(colour.difference.delta_E_CIE2000(lab(tested), lab(reference)))


def delta_e_itp_map(tested: np.ndarray, reference: np.ndarray, white: float = REFERENCE_WHITE) -> np.ndarray:
    """ΔE_ITP per pixel of two scene-linear Rec.709 images.

    Args:
        tested: (H, W, 3) scene-linear; values below 0 cd/m² or above 10 000 are clamped, as PQ has no code for them.
        reference: the same.
        white: the luminance in cd/m² at which a scene-linear 1 is shown.

    Returns:
        (H, W) float64, 0 is equal, 1 just noticeable in the most critical adaptation.

    Raises:
        InputError: white is not above 0.
    """
    if not (np.isfinite(white) and white > 0):
        raise InputError(
            "ΔE_ITP needs a white",
            expected="a luminance above 0 cd/m²",
            actual=str(white),
            remedy=f"BT.2408's is {REFERENCE_WHITE:g}.",
        )
    colour = _colour()
    spaces = colour.RGB_COLOURSPACES
    matrix = np.linalg.inv(spaces["ITU-R BT.2020"].matrix_RGB_to_XYZ) @ spaces["sRGB"].matrix_RGB_to_XYZ

    def ictcp(radiance: np.ndarray) -> np.ndarray:
        rgb = (np.maximum(np.asarray(radiance, np.float64), 0) * white) @ matrix.T
        return colour.RGB_to_ICtCp(np.clip(rgb, 0, _PQ_PEAK), method="ITU-R BT.2100-2 PQ")

    return np.asarray(colour.difference.delta_E_ITP(ictcp(tested), ictcp(reference)))


def delta_e_2000(
    comparison: Comparison,
    display: Callable[[np.ndarray], np.ndarray] | None = None,
    bound: bool = True,
) -> Measurement:
    """Mean ΔE2000 of the display images, clamped to [0, 1]; reported as `noisy_mean` says.

    Args:
        comparison: the two sides, scene-linear, or sRGB-encoded display values where `display` is None.
        display: maps (H, W, 3) scene-linear to sRGB-encoded [0, 1]; put on both sides.
        bound: whether to look for the bound, or only for the floor.
    """
    error = ErrorMap("delta_e_2000", delta_e_2000_map, display)
    return measure_map(comparison, error, how="ΔE2000", unit="ΔE", bound=bound)


def delta_e_itp(comparison: Comparison, white: float = REFERENCE_WHITE, bound: bool = True) -> Measurement:
    """Mean ΔE_ITP of scene-linear images; reported as `noisy_mean` says. Luminances are clamped to what PQ encodes.

    Args:
        comparison: the two sides, scene-linear Rec.709.
        white: the luminance in cd/m² at which a scene-linear 1 is shown.
        bound: whether to look for the bound, or only for the floor.
    """
    error = ErrorMap(("delta_e_itp", white), lambda t, r: delta_e_itp_map(t, r, white))
    return measure_map(comparison, error, how=f"ΔE_ITP, white at {white:g} cd/m²", unit="ΔE", bound=bound)


def _colour():
    """colour-science, imported when first needed: it takes a second, and warns that it cannot plot."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        import colour
    return colour
