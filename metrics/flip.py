"""FLIP: the difference a viewer sees when two images are flipped back and forth.

LDR: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild: "FLIP: A Difference Evaluator for
Alternating Images", HPG 2020. HDR: Andersson, Nilsson, Shirley, Akenine-Möller: "Visualizing Errors in
Rendered High Dynamic Range Images", Eurographics 2021. Constants are the papers'.

The filters are separable (a Gaussian, its two derivatives, and a sum of two Gaussians). They are applied as
products with small banded matrices, tile by tile: a matrix product over a tile of 64 pixels with its margin
does four times the arithmetic of a direct convolution, but BLAS does it at ten times the speed. Everything is
float32, channel first, in strips of rows that stay in the cache, on a thread per core.

A pixel that is not finite makes the map NaN wherever its filters reach (HDR: everywhere, as the exposures are then
unknown), and so the mean NaN: it is never averaged away. Values outside [0, 1] (LDR) or below 0 (HDR) are clamped:
no display shows them.
"""

from __future__ import annotations

import math
import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.lib.stride_tricks import as_strided

from .comparison import Comparison
from .input_error import InputError
from .measurement import Measurement
from .noisy_mean import ErrorMap, measure_map

# 0.7 m from a display 0.7 m and 3840 pixels wide: the papers' viewing condition, 67.02 pixels a degree.
PIXELS_PER_DEGREE = 0.7 * 3840 / 0.7 * math.pi / 180

_QC, _PC, _PT = 0.7, 0.4, 0.95  # colour pipeline: exponent, knee's position, knee's value (2020, section 4.1)
_FEATURE_WIDTH, _QF = 0.082, 0.5  # feature pipeline: detector width in degrees, exponent (2020, section 4.2)
# Contrast sensitivity as Gaussians a·sqrt(π/b)·exp(−π²x²/b), x in degrees (2020, table 1).
_ACHROMATIC, _RED_GREEN = (1.0, 0.0047), (1.0, 0.0053)
_BLUE_YELLOW = ((34.1, 0.04), (13.5, 0.025))

# Linear sRGB to CIE XYZ with the white of the matrix's own row sums, as NVIDIA's code has it.
_XYZ = np.array(
    [
        [10135552 / 24577794, 8788810 / 24577794, 4435075 / 24577794],
        [2613072 / 12288897, 8788810 / 12288897, 887015 / 12288897],
        [1425312 / 73733382, 8788810 / 73733382, 70074185 / 73733382],
    ]
)
_NORMALISED_XYZ = _XYZ / _XYZ.sum(axis=1, keepdims=True)
# YCxCz without its scale factors, which are linear and would cancel: (Y, X − Y, Y − Z) over white.
_OPPONENT = np.array([[0, 1, 0], [1, -1, 0], [0, 1, -1]]) @ _NORMALISED_XYZ
_TO_OPPONENT = _OPPONENT.astype(np.float32)
_FROM_OPPONENT = np.linalg.inv(_OPPONENT).astype(np.float32)
_TO_XYZ = _NORMALISED_XYZ.astype(np.float32)

# The 2021 paper's tone curve: Narkowicz' fit of ACES with its pre-exposure of 0.6 taken out; rational,
# (c0 x² + c1 x + c2) / (c3 x² + c4 x + c5).
_ACES = (0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.0, 0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14)
_EXPOSURE_TARGET = 0.85  # the tone-mapped value that the brightest and the median luminance are brought to
_DARKEST = float(np.finfo(np.float32).tiny)
_LUMINANCE = np.array([0.2126, 0.7152, 0.0722], dtype=np.float32)

_TILE = 64  # output pixels a matrix product; 64 keeps the arithmetic low and the product large enough
_STRIP = 64  # rows worked on at once: 64 × 512 pixels with all intermediates fit a 2 MB cache


Filtered = tuple[np.ndarray, tuple[np.ndarray, np.ndarray]]
"""A strip's filtered colours and its features' strengths."""


class FlipAgainst:
    """LDR-FLIP of many display images against one, which is filtered once: half the work.

    Args:
        reference: (H, W, 3), sRGB-encoded display values in [0, 1]; values outside are clamped.
        pixels_per_degree: pixels per degree of the viewer's visual angle.

    Raises:
        InputError: as `ldr_flip`.
    """

    def __init__(self, reference: np.ndarray, pixels_per_degree: float = PIXELS_PER_DEGREE) -> None:
        self._reference, self._ppd = reference, pixels_per_degree
        (image,) = _checked(reference, reference, pixels_per_degree)[:1]
        self._strips = list(map(self._filter, self._windows(image)))

    def __call__(self, tested: np.ndarray) -> np.ndarray:
        """The error map as `ldr_flip` gives it, on one thread: callers have many images for their threads.

        Args:
            tested: (H, W, 3), as the reference.

        Returns:
            (H, W) float32 in [0, 1]; NaN around a pixel that is not finite.
        """
        image, _ = _checked(tested, self._reference, self._ppd)
        height, width = image.shape[:2]
        windows = zip(self._windows(image), self._strips, strict=True)
        rows = [_difference(self._filter(window), known)[:, :width] for window, known in windows]
        return np.concatenate(rows)[:height]

    def _filter(self, window: np.ndarray) -> Filtered:
        return _filtered(_decode_srgb(window), self._ppd)

    def _windows(self, image: np.ndarray):
        radius, _, _ = _operators(self._ppd)
        planes = _padded(image, self._ppd)
        for top in range(0, image.shape[0], _STRIP):
            yield planes[:, top : top + _STRIP + 2 * radius]


@dataclass(frozen=True)
class HdrFlip:
    """The result of HDR-FLIP.

    Attributes:
        error: (H, W) float32 in [0, 1], the largest LDR-FLIP over the exposures.
        exposure: (H, W) float32, the exposure in stops at which `error` was reached.
        start: the first exposure in stops.
        stop: the last exposure in stops.
        count: how many exposures were looked at.
    """

    error: np.ndarray
    exposure: np.ndarray
    start: float
    stop: float
    count: int


def ldr_flip(tested: np.ndarray, reference: np.ndarray, pixels_per_degree: float = PIXELS_PER_DEGREE) -> np.ndarray:
    """LDR-FLIP's error map of two display images.

    Args:
        tested: (H, W, 3), sRGB-encoded display values in [0, 1]; values outside are clamped.
        reference: the same, of the same size.
        pixels_per_degree: pixels per degree of the viewer's visual angle.

    Returns:
        (H, W) float32 in [0, 1]; NaN around a pixel that is not finite.

    Raises:
        InputError: the sizes differ, an image is not (H, W, 3), or pixels_per_degree is not positive.

    Source: Andersson et al. 2020.
    """
    images = _checked(tested, reference, pixels_per_degree)
    return _evaluate(images, [_decode_srgb], pixels_per_degree)[0]


def hdr_flip(
    tested: np.ndarray,
    reference: np.ndarray,
    pixels_per_degree: float = PIXELS_PER_DEGREE,
    start: float | None = None,
    stop: float | None = None,
    count: int | None = None,
) -> HdrFlip:
    """HDR-FLIP: the largest LDR-FLIP over a range of exposures.

    The range brings the reference's brightest, at the other end its median luminance to 0.85 after tone mapping.
    Where the median is 0 (more than half of the image is black) the median of the luminances above 0 is
    taken; where the whole reference is black, the tested image gives the range instead, so that light where
    there should be none is seen; two black images have error 0. (NVIDIA's code has no answer there.)
    Luminances below float32's smallest normal number, 1.2e-38, are black: no float32 exposure would show them.

    Args:
        tested: (H, W, 3), scene-linear Rec.709 radiance; values below 0 are clamped.
        reference: the same, of the same size.
        pixels_per_degree: pixels per degree of the viewer's visual angle.
        start: first exposure in stops; from the reference when None.
        stop: last exposure in stops, at least `start`; from the reference when None.
        count: number of exposures, 2 or more; one a stop when None.

    Returns:
        The error map, the exposure that each error was seen at, and the range.

    Raises:
        InputError: the sizes differ, an image is not (H, W, 3), or an exposure or pixels_per_degree makes no sense.

    Source: Andersson et al. 2021.
    """
    images = _checked(tested, reference, pixels_per_degree)
    if not (np.isfinite(images[0]).all() and np.isfinite(images[1]).all()):
        nothing = np.full(images[0].shape[:2], np.nan, np.float32)
        return HdrFlip(nothing, nothing.copy(), math.nan, math.nan, 0)
    found_start, found_stop = exposure_range(images[1], images[0])
    start = found_start if start is None else float(start)
    stop = found_stop if stop is None else float(stop)
    if not (math.isfinite(start) and math.isfinite(stop) and start <= stop):
        raise InputError(
            "HDR-FLIP's exposures are out of order",
            expected="start ≤ stop, both finite",
            actual=f"start={start:g}, stop={stop:g}",
            remedy="Leave both out to take them from the reference.",
        )
    # In float32, as NVIDIA rounds it: the ceiling of a difference that is whole must not be one more.
    count = max(2, math.ceil(np.float32(stop) - np.float32(start))) if count is None else count
    if count < 2:
        raise InputError(
            "HDR-FLIP needs a range of exposures",
            expected="a count of 2 or more",
            actual=str(count),
            remedy="Leave it out for one exposure a stop.",
        )
    stops = [start + i * (stop - start) / (count - 1) for i in range(count)]
    error, which = _evaluate(images, [_exposed(s) for s in stops], pixels_per_degree)
    return HdrFlip(error, np.asarray(stops, np.float32)[which], start, stop, count)


def exposure_range(reference: np.ndarray, tested: np.ndarray) -> tuple[float, float]:
    """The exposures, in stops, between which HDR-FLIP looks; see `hdr_flip` for what black images give.

    Args:
        reference: (H, W, 3) finite scene-linear radiance.
        tested: (H, W, 3) finite scene-linear radiance, asked only when the reference is black.

    Returns:
        (start, stop), start ≤ stop.

    Source: Andersson et al. 2021, section 4.
    """
    c0, c1, c2, c3, c4, c5 = _ACES
    a, b, c = (p - _EXPOSURE_TARGET * q for p, q in ((c0, c3), (c1, c4), (c2, c5)))
    bright = -b / (2 * a) + math.sqrt((b / (2 * a)) ** 2 - c / a)
    for image in (reference, tested):
        # float32 and channel by channel, as NVIDIA sums it: the number of exposures is a ceiling, so a last
        # bit could add one.
        r, g, b = (np.maximum(image[..., i], 0).astype(np.float32) * _LUMINANCE[i] for i in range(3))
        luminance = (r + g + b).ravel()
        largest = float(luminance.max())
        if largest >= _DARKEST:
            middle = luminance.size // 2
            median = float(np.partition(luminance, middle)[middle])
            if median < _DARKEST:
                lit = luminance[luminance >= _DARKEST]
                median = float(np.partition(lit, lit.size // 2)[lit.size // 2])
            start, stop = (np.float32(math.log2(np.float32(bright) / y)) for y in (largest, median))
            return float(start), float(stop)
    return 0.0, 0.0


def flip(
    comparison: Comparison,
    display: Callable[[np.ndarray], np.ndarray] | None = None,
    pixels_per_degree: float = PIXELS_PER_DEGREE,
    bound: bool = True,
) -> Measurement:
    """Mean LDR-FLIP of the display images, in [0, 1]; 0 is equal. Display values outside [0, 1] are clamped.

    Args:
        comparison: the two sides, scene-linear, or display values where `display` is None.
        display: maps (H, W, 3) scene-linear to sRGB-encoded [0, 1]; put on both sides.
        pixels_per_degree: pixels per degree of the viewer's visual angle.
        bound: whether to look for the bound, or only for the floor.

    Source: Andersson et al. 2020. Reported as `noisy_mean` says.
    """
    return measure_map(
        comparison,
        flip_error(display, pixels_per_degree),
        how=f"FLIP, {pixels_per_degree:.1f} pixels per degree",
        bound=bound,
    )


def flip_error(display: Callable[[np.ndarray], np.ndarray] | None, pixels_per_degree: float) -> ErrorMap:
    """LDR-FLIP's map, (H, W) in [0, 1], as the metrics that read it share it.

    Args:
        display: from (H, W, 3) to code values in [0, 1]; None where the images are such values already.
        pixels_per_degree: pixels per degree of the viewer's visual angle.
    """
    return ErrorMap(("flip", pixels_per_degree), lambda t, r: ldr_flip(t, r, pixels_per_degree), display, spatial=True)


def flip_hdr(comparison: Comparison, pixels_per_degree: float = PIXELS_PER_DEGREE, bound: bool = True) -> Measurement:
    """Mean HDR-FLIP of scene-linear images, in [0, 1]; 0 is equal. Negative radiance is clamped to 0.

    Args:
        comparison: the two sides, scene-linear.
        pixels_per_degree: pixels per degree of the viewer's visual angle.
        bound: whether to look for the bound, or only for the floor.

    Source: Andersson et al. 2021. Reported as `noisy_mean` says. All replicates use the exposures of the
    full mean: with exposures of their own they would differ by more than their noise.
    """
    if comparison.unusable(spatial=True):
        return comparison.failure("")
    comparison.check_reference(None)
    start, stop = exposure_range(comparison.mean_reference, comparison.mean_tested)
    return measure_map(
        comparison,
        ErrorMap(
            ("flip_hdr", pixels_per_degree),
            lambda t, r: hdr_flip(t, r, pixels_per_degree, start, stop).error,
            spatial=True,
        ),
        how=f"HDR-FLIP, {pixels_per_degree:.1f} pixels per degree, {start:.2f} to {stop:.2f} stops",
        bound=bound,
    )


def _checked(tested: np.ndarray, reference: np.ndarray, pixels_per_degree: float) -> list[np.ndarray]:
    images = [np.asarray(tested), np.asarray(reference)]
    for image, side in zip(images, ("tested", "reference"), strict=True):
        if image.ndim != 3 or image.shape[2] != 3 or 0 in image.shape:
            raise InputError(
                f"the {side} image is not a colour image",
                expected="shape (height, width, 3)",
                actual=str(image.shape),
                remedy="Give three channels; repeat a grey image three times.",
            )
    if images[0].shape != images[1].shape:
        raise InputError(
            "the images differ in size",
            expected=f"{images[1].shape[1]}×{images[1].shape[0]}, the reference's size",
            actual=f"{images[0].shape[1]}×{images[0].shape[0]}",
            remedy="Render or resample one of them to the other's size.",
        )
    if not (math.isfinite(pixels_per_degree) and pixels_per_degree > 0):
        raise InputError(
            "the viewing condition makes no sense",
            expected="pixels_per_degree above 0",
            actual=str(pixels_per_degree),
            remedy=f"The usual value is {PIXELS_PER_DEGREE:.1f}.",
        )
    return images


def _finite_or_nan(image: np.ndarray) -> np.ndarray:
    """float32 with NaN for infinities, which clamping would turn into valid colours."""
    with np.errstate(over="ignore"):
        image = image.astype(np.float32, copy=False)
    finite = np.isfinite(image)
    return image if finite.all() else np.where(finite, image, np.float32(np.nan))


def _decode_srgb(encoded: np.ndarray) -> np.ndarray:
    """sRGB values, clamped to [0, 1], to linear (IEC 61966-2-1)."""
    clamped = np.clip(encoded, 0, 1)
    return np.where(
        clamped <= np.float32(0.04045),
        clamped * np.float32(1 / 12.92),
        ((clamped + np.float32(0.055)) * np.float32(1 / 1.055)) ** np.float32(2.4),
    )


def _exposed(stops: float) -> Callable[[np.ndarray], np.ndarray]:
    """The tone curve at an exposure, clamped to [0, 1]."""
    scale = np.float32(2.0**stops)
    c0, c1, _, c3, c4, c5 = (np.float32(c) for c in _ACES)
    # Above this the curve is within a float32's last bit of its limit and x² would overflow later.
    limit = np.float32(1e9)

    def tone(radiance: np.ndarray) -> np.ndarray:
        with np.errstate(over="ignore"):
            x = np.clip(radiance * scale, 0, limit)
        return np.minimum(x * (c0 * x + c1) / (x * (c3 * x + c4) + c5), np.float32(1))

    return tone


@lru_cache(maxsize=8)
def _kernels(pixels_per_degree: float) -> tuple[np.ndarray, ...]:
    """1-D kernels (achromatic, red-green, blue-yellow ×2, Gaussian, first, second derivative), one length."""
    widest = max(b for _, b in (_ACHROMATIC, _RED_GREEN, *_BLUE_YELLOW))
    spatial_radius = math.ceil(3 * math.sqrt(widest / (2 * math.pi**2)) * pixels_per_degree)
    deviation = 0.5 * _FEATURE_WIDTH * pixels_per_degree
    feature_radius = math.ceil(3 * deviation)
    radius = max(spatial_radius, feature_radius)
    x = np.arange(-radius, radius + 1, dtype=np.float64)

    degrees = x / pixels_per_degree
    in_reach = np.abs(x) <= spatial_radius
    single = [np.exp(-(math.pi**2) * degrees**2 / b) * in_reach for _, b in (_ACHROMATIC, _RED_GREEN)]
    # A sum of two Gaussians is not separable, each of them is: the square root of its amplitude goes to each
    # axis, and the pair is normalised together.
    pair = [
        math.sqrt(a * math.sqrt(math.pi / b)) * np.exp(-(math.pi**2) * degrees**2 / b) * in_reach
        for a, b in _BLUE_YELLOW
    ]
    norm = math.sqrt(sum(k.sum() ** 2 for k in pair))

    gauss = np.exp(-(x**2) / (2 * deviation**2)) * (np.abs(x) <= feature_radius)
    derivatives = []
    for shape in (-x * gauss, (x**2 / deviation**2 - 1) * gauss):
        positive, negative = shape[shape > 0].sum(), -shape[shape < 0].sum()
        derivatives.append(np.where(shape > 0, shape / positive, shape / negative))
    kernels = [k / k.sum() for k in single] + [k / norm for k in pair] + [gauss / gauss.sum(), *derivatives]
    return tuple(kernels)


@lru_cache(maxsize=8)
def _bands(pixels_per_degree: float, size: int) -> dict[str, np.ndarray]:
    """Banded matrices, (size + 2r, size) each: windows of pixels to `size` filtered ones."""
    kernels = _kernels(pixels_per_degree)
    names = ("y", "cx", "cz1", "cz2", "gauss", "first", "second")
    bands = {}
    for name, kernel in zip(names, kernels, strict=True):
        band = np.zeros((size + kernel.size - 1, size), np.float32)
        for column in range(size):
            band[column : column + kernel.size, column] = kernel
        bands[name] = band
    return bands


@lru_cache(maxsize=8)
def _operators(pixels_per_degree: float) -> tuple[int, tuple[np.ndarray, ...], tuple[np.ndarray, ...]]:
    """The filters' radius, and the matrices along x (to the right) and along y (to the left)."""
    radius = _kernels(pixels_per_degree)[0].size // 2
    x, y = _bands(pixels_per_degree, _TILE), _bands(pixels_per_degree, _STRIP)
    along_x = (
        np.hstack([x["y"], x["first"], x["second"], x["gauss"]]),
        x["cx"],
        np.hstack([x["cz1"], x["cz2"]]),
    )
    along_y = (
        y["y"].T,
        y["cx"].T,
        np.hstack([y["cz1"].T, y["cz2"].T]),
        y["gauss"].T,
        np.vstack([y["first"].T, y["second"].T]),
    )
    return radius, along_x, tuple(np.ascontiguousarray(m) for m in along_y)


def _largest_colour_difference() -> float:
    """The HyAB distance, to the power of 0.7, between green and blue: what the map calls 1."""
    ends = [_hunt_lab(np.array(rgb, np.float32).reshape(3, 1)) for rgb in ((0, 1, 0), (0, 0, 1))]
    return float(_hyab(*ends)[0]) ** _QC


def _hunt_lab(linear: np.ndarray) -> np.ndarray:
    """Linear RGB, (3, n), to CIELAB with the Hunt effect: chroma scaled by lightness (2020, eq. 5)."""
    xyz = _TO_XYZ @ linear
    delta = 6 / 29
    f = np.where(
        xyz > np.float32(delta**3),
        np.cbrt(xyz),
        xyz * np.float32(1 / (3 * delta**2)) + np.float32(4 / 29),
    )
    lab = np.empty_like(f)
    np.multiply(f[1], np.float32(116), out=lab[0])
    lab[0] -= np.float32(16)
    np.subtract(f[0], f[1], out=lab[1])
    lab[1] *= lab[0] * np.float32(5)
    np.subtract(f[1], f[2], out=lab[2])
    lab[2] *= lab[0] * np.float32(2)
    return lab


def _hyab(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    d = a - b
    return np.abs(d[0]) + np.sqrt(d[1] * d[1] + d[2] * d[2])


_COLOUR_MAX = _largest_colour_difference()


def _evaluate(
    images: list[np.ndarray], to_linear: list[Callable[[np.ndarray], np.ndarray]], pixels_per_degree: float
) -> tuple[np.ndarray, np.ndarray]:
    """The largest LDR-FLIP over several transforms to linear display RGB, and which of them gave it."""
    height, width = images[0].shape[:2]
    radius, _, _ = _operators(pixels_per_degree)
    planes = [_padded(image, pixels_per_degree) for image in images]
    error = np.zeros((height, width), np.float32)
    which = np.zeros((height, width), np.intp)

    def strip(top: int) -> None:
        rows = slice(top, min(top + _STRIP, height))
        n = rows.stop - rows.start
        windows = [p[:, top : top + _STRIP + 2 * radius] for p in planes]
        for index, transform in enumerate(to_linear):
            found = _difference(*(_filtered(transform(w), pixels_per_degree) for w in windows))[:n, :width]
            if index == 0:
                error[rows] = found
            else:
                higher = ~(found <= error[rows])  # NaN counts as higher, so that it stays
                error[rows][higher] = found[higher]
                which[rows][higher] = index

    tops = range(0, height, _STRIP)
    workers = min(len(tops), os.cpu_count() or 1)
    if workers == 1:
        for top in tops:
            strip(top)
    else:
        with ThreadPoolExecutor(workers) as pool:
            list(pool.map(strip, tops))
    return error, which


def _padded(image: np.ndarray, pixels_per_degree: float) -> np.ndarray:
    """(3, rows, columns) of (H, W, 3) with the filters' margin and whole strips and tiles."""
    height, width = image.shape[:2]
    radius, _, _ = _operators(pixels_per_degree)
    # Edges repeat (2020, section 4); the right and lower rest of the last tile is padding too.
    right, below = -width % _TILE, -height % _STRIP
    pad = ((radius, radius + below), (radius, radius + right), (0, 0))
    return np.ascontiguousarray(np.pad(_finite_or_nan(image), pad, mode="edge").transpose(2, 0, 1))


def _difference(a: Filtered, b: Filtered) -> np.ndarray:
    """FLIP of one strip, (_STRIP, tiles), from what `_filtered` made of both images."""
    labs, features = zip(a, b, strict=True)
    colour = _hyab(*labs) ** np.float32(_QC)
    knee = _PC * _COLOUR_MAX
    above = np.float32((1 - _PT) / (_COLOUR_MAX - knee))
    colour = np.where(
        colour < np.float32(knee),
        colour * np.float32(_PT / knee),
        np.float32(_PT) + (colour - np.float32(knee)) * above,
    )
    edge, point = (np.abs(a - b) for a, b in zip(*features, strict=True))
    feature = np.sqrt(np.maximum(edge, point) * np.float32(math.sqrt(0.5)))  # _QF = 0.5 is a square root
    return colour.reshape(feature.shape) ** (1 - feature)


def _filtered(linear: np.ndarray, pixels_per_degree: float) -> Filtered:
    """One image's strip, linear RGB (3, _STRIP + 2r, tiles + 2r), to Hunt-adjusted Lab (3, n) after contrast
    filtering, and (edge, point) strengths."""
    radius, along_x, along_y = _operators(pixels_per_degree)
    _, rows, columns = linear.shape
    tiles = (columns - 2 * radius) // _TILE
    opponent = (_TO_OPPONENT @ linear.reshape(3, -1)).reshape(linear.shape)

    def filter_x(plane: np.ndarray, matrix: np.ndarray) -> np.ndarray:
        """(filters, rows, tiles · _TILE): all tiles' overlapping windows times the band matrix."""
        step = plane.strides[1]
        view = as_strided(plane, (tiles, rows, _TILE + 2 * radius), (_TILE * step, plane.strides[0], step))
        product = np.matmul(view, matrix).reshape(tiles, rows, -1, _TILE)
        return product.transpose(2, 1, 0, 3).reshape(-1, rows, tiles * _TILE)

    y, dx, ddx, smooth = filter_x(opponent[0], along_x[0])
    (cx,) = filter_x(opponent[1], along_x[1])
    cz = filter_x(opponent[2], along_x[2])

    filtered = np.empty((3, _STRIP, tiles * _TILE), np.float32)
    np.matmul(along_y[0], y, out=filtered[0])
    np.matmul(along_y[1], cx, out=filtered[1])
    np.matmul(along_y[2], cz.reshape(2 * rows, -1), out=filtered[2])
    dy_ddy = along_y[4] @ smooth
    dx, ddx = along_y[3] @ dx, along_y[3] @ ddx
    dy, ddy = dy_ddy[:_STRIP], dy_ddy[_STRIP:]

    rgb = _FROM_OPPONENT @ filtered.reshape(3, -1)
    np.clip(rgb, 0, 1, out=rgb)
    return _hunt_lab(rgb), (np.sqrt(dx * dx + dy * dy), np.sqrt(ddx * ddx + ddy * ddy))
