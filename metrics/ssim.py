"""Structural similarity.

Wang, Bovik, Sheikh, Simoncelli: "Image Quality Assessment: From Error Visibility to Structural Similarity", IEEE
TIP 2004; scikit-image's implementation with the paper's window: Gaussian, σ = 1.5, 11 × 11.
"""

from collections.abc import Callable

import numpy as np

from .comparison import Comparison
from .input_error import InputError
from .measurement import Measurement
from .noisy_mean import ErrorMap, measure_map

WINDOW = 11
_RADIUS = WINDOW // 2
_FLOAT32_RANGES = 1e3  # SSIM takes fourth powers of values: beyond so many data ranges float32 has no digits left


def ssim_map(tested: np.ndarray, reference: np.ndarray, data_range: float = 1.0) -> np.ndarray:
    """SSIM per pixel, mean over channels, in [−1, 1]; 1 is equal.

    Args:
        tested: (H, W, 3), both sides at least 11.
        reference: the same.
        data_range: the difference between the largest and the smallest value a pixel may have.

    Returns:
        (H, W) float32, NaN in the border of 5 pixels where the window leaves the image.

    Raises:
        InputError: an image is smaller than the window, or the sizes differ.
    """
    from skimage.metrics import structural_similarity

    if tested.shape != reference.shape:
        raise InputError(
            "the images differ in size",
            expected=str(reference.shape),
            actual=str(tested.shape),
            remedy="Render or resample one of them to the other's size.",
        )
    if min(reference.shape[:2]) < WINDOW:
        raise InputError(
            "the images are smaller than SSIM's window",
            expected=f"at least {WINDOW}×{WINDOW} pixels",
            actual=f"{reference.shape[1]}×{reference.shape[0]}",
            remedy="Use larger images, or a pixel-wise metric such as rmse.",
        )
    # SSIM stays the same where values and range are scaled alike. Whatever float32 holds has a fourth power in float64.
    tested, reference = tested / data_range, reference / data_range
    largest = max(float(np.abs(image).max()) for image in (tested, reference))
    precision = np.float32 if largest <= _FLOAT32_RANGES else np.float64
    # With `full`, the mean and the map: scikit-image's own type cannot say so.
    _, similarity = structural_similarity(  # pyright: ignore[reportAssignmentType]
        np.asarray(tested, precision),
        np.asarray(reference, precision),
        data_range=1.0,
        channel_axis=2,
        gaussian_weights=True,
        sigma=1.5,
        use_sample_covariance=False,
        full=True,
    )
    result = similarity.mean(axis=2, dtype=np.float32)
    inside = np.zeros(result.shape, bool)
    inside[_RADIUS:-_RADIUS, _RADIUS:-_RADIUS] = True
    result[~inside] = np.nan
    return result


def ssim(
    comparison: Comparison,
    display: Callable[[np.ndarray], np.ndarray] | None = None,
    data_range: float = 1.0,
    bound: bool = True,
) -> Measurement:
    """Mean SSIM of the display images, 1 is equal.

    Values outside [0, data_range], negative ones too, are taken as they are. Reported as `noisy_mean` says.

    Args:
        comparison: the two sides, scene-linear, or display values where `display` is None.
        display: maps (H, W, 3) scene-linear to display values; put on both sides.
        data_range: the range of display values, 1 for [0, 1].
        bound: whether to look for the bound, or only for the floor.

    Raises:
        InputError: the images are smaller than 11 × 11, or no pixel of the mask is 5 pixels from the border.
    """
    inner = slice(_RADIUS, -_RADIUS)
    if comparison.mask is not None and min(comparison.height, comparison.width) >= WINDOW:
        count = int(comparison.mask[inner, inner].sum())
        if count == 0:
            raise InputError(
                "SSIM's window leaves the image at every pixel of the mask",
                expected=f"a pixel at least {_RADIUS} from the border",
                actual="none",
                remedy="Widen the mask, or use a pixel-wise metric such as rmse.",
            )

    def inside_mean(values: np.ndarray, mask: np.ndarray | None) -> float:
        """The border has no value."""
        inside = values[inner, inner] if mask is None else values[inner, inner][mask[inner, inner]]
        return float(np.mean(inside, dtype=np.float64))

    return measure_map(
        comparison,
        ErrorMap(("ssim", data_range), lambda t, r: ssim_map(t, r, data_range), display, spatial=True),
        inside_mean,
        how=f"SSIM, {WINDOW}×{WINDOW} Gaussian window, data range {data_range:g}",
        perfect=1.0,
        larger_is_worse=False,
        bound=bound,
    )
