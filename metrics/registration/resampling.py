"""Resampling where rows and columns go their own ways: flips, shifts and scales."""

import numpy as np


def taps(coordinates: np.ndarray, length: int) -> tuple[np.ndarray, np.ndarray]:
    """The four samples around each coordinate and their weights (Keys 1981, cubic convolution, a = −1/2).

    Args:
        coordinates: (n,) in samples; sample 0 is at 0.
        length: how many samples there are; those beyond an end repeat it.

    Returns:
        (4, n) indices and (4, n) weights.
    """
    first = np.floor(coordinates)
    t = coordinates - first
    weights = np.stack(
        [
            ((-0.5 * t + 1.0) * t - 0.5) * t,
            (1.5 * t - 2.5) * t * t + 1.0,
            ((-1.5 * t + 2.0) * t + 0.5) * t,
            (0.5 * t - 0.5) * t * t,
        ]
    )
    return np.clip(first.astype(int) + np.arange(-1, 3)[:, None], 0, length - 1), weights


def resample(image: np.ndarray, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """An image at other places: pixel (i, j) of the result is the image at (rows[i], columns[j]).

    Cubic, kept within the two samples between which a value lies, so that a bright pixel does not darken its
    neighbours below 0. Beyond the border the border's pixels repeat.

    Args:
        image: (H, W) or (H, W, C).
        rows: (n,) in pixels, pixel 0's centre at 0.
        columns: (m,) likewise.

    Returns:
        (n, m) or (n, m, C), of the image's type.
    """
    across = _along_rows(image, rows)
    return np.swapaxes(_along_rows(np.swapaxes(across, 0, 1), columns), 0, 1).astype(image.dtype, copy=False)


def _along_rows(image: np.ndarray, rows: np.ndarray) -> np.ndarray:
    if np.array_equal(rows, np.arange(len(image))):
        return image
    where, weights = taps(rows, len(image))
    shape = (-1,) + (1,) * (image.ndim - 1)
    samples = [image[index] for index in where]
    value = sum(sample * weight.reshape(shape) for sample, weight in zip(samples, weights, strict=True))
    return np.clip(value, np.minimum(samples[1], samples[2]), np.maximum(samples[1], samples[2]))


def reduce(image: np.ndarray, factor: int) -> np.ndarray:
    """An image at a lower resolution: the means of factor × factor pixels; what is over at the end is left out.

    Args:
        image: (H, W) or (H, W, C).
    """
    if factor == 1:
        return image
    height, width = (side // factor for side in image.shape[:2])
    cut = image[: height * factor, : width * factor]
    rows = cut.reshape(height, factor, width * factor, *image.shape[2:]).sum(axis=1)
    return rows.reshape(height, width, factor, *image.shape[2:]).sum(axis=2) / factor**2
