"""How an aperture spreads a point of light over the picture: Fraunhofer diffraction (Born & Wolf 1999, section 8.3).

With x the place in the picture in units of wavelength times f-number, the density is |A(2πx)|² over the aperture's
area, A being the Fourier transform of the opening measured in its circle's diameters. It is averaged over each pixel
and over each channel's band of wavelengths, since rings are finer than pixels. Its sum over the plane is 1.
"""

import math
from functools import lru_cache

import numpy as np

from lightmeter.groundtruth import wavefront
from lightmeter.groundtruth.variant import dr, mi
from lightmeter.scenes.aperture import Aperture

BANDS = ((580e-9, 660e-9), (500e-9, 580e-9), (430e-9, 510e-9))
"""Wavelengths of red, green and blue, metres: even bands about the peaks of a sensor's channels."""
SAMPLES = 64
"""Per pixel; a tail's pixel holds some tens of rings."""
CORE, CORE_SAMPLES = 8, 1 << 14
"""Pixels from the centre within which the density is steep, and samples there."""
_STREAM = 0xD1FF


@lru_cache(maxsize=4)
def point_spread(aperture: Aperture, size: tuple[int, int]) -> np.ndarray:
    """The part of a pixel's light that arrives in each pixel about it.

    Args:
        size: of the picture, width and height in pixels.

    Returns:
        (2H − 1, 2W − 1, 3) float64; the pixel itself is in the middle. Symmetric about it.
    """
    width, height = size
    right, down = np.meshgrid(np.arange(1 - width, width), np.arange(1 - height, height))
    half = (down > 0) | ((down == 0) & (right >= 0))  # the other half is the same
    core = half & (np.maximum(np.abs(right), np.abs(down)) <= CORE)
    spread = np.zeros((*right.shape, 3))
    for chosen, samples in ((core, CORE_SAMPLES), (half & ~core, SAMPLES)):
        if chosen.any():
            places = np.stack([right[chosen], -down[chosen]])
            spread[chosen] = _averages(aperture, height, places, samples).T
    spread = np.where(half[..., None], spread, spread[::-1, ::-1])
    # In its own pixel a point's light is too steep for samples; it is what arrives nowhere else.
    spread[height - 1, width - 1] = 0
    spread[height - 1, width - 1] = 1 - spread.sum(axis=(0, 1)) - _beyond(aperture, size)
    return spread


def _beyond(aperture: Aperture, size: tuple[int, int]) -> np.ndarray:
    """(3,) what arrives outside the picture that `point_spread` is of.

    Averaged over directions the density falls as c/(2πr³) with c = P/(2π²·area), P being the perimeter: for a circle
    this is the tail of 1 − J₀² − J₁². Outside a rectangle of half sides a and b that is 2c·√(a² + b²)/(π·a·b).
    """
    corners = aperture.corners
    perimeter = float(np.linalg.norm(corners - np.roll(corners, 1, axis=0), axis=1).sum()) if aperture.blades else np.pi
    wavelengths = np.array([(low + high) / 2 for low, high in BANDS])
    a, b = (np.array([side - 0.5]) * aperture.sensor_height / size[1] for side in size)
    a, b = a / (wavelengths * aperture.f_number), b / (wavelengths * aperture.f_number)
    return perimeter / (2 * np.pi**2 * np.pi / 4) * 2 * np.hypot(a, b) / (np.pi * a * b)


def _averages(aperture: Aperture, height: int, places: np.ndarray, samples: int) -> np.ndarray:
    """(3, n): what arrives in the pixels at (2, n) places, right and up of the source's."""
    pitch = aperture.sensor_height / height
    x, y = (mi.Float(row.astype(np.float32)) for row in places)

    def estimate(lanes):
        inside = lanes.pattern.next_2d() - 0.5
        across = dr.gather(mi.Float, x, lanes.place) + inside.x
        up = dr.gather(mi.Float, y, lanes.place) + inside.y
        along = lanes.pattern.next()
        found = []
        for low, high in BANDS:
            scale = pitch / ((low + along * (high - low)) * aperture.f_number)  # pixels to x
            found.append(density(aperture, mi.Point2f(across * scale, up * scale)) * scale * scale)
        return found

    return wavefront.average(places.shape[1], samples, (_STREAM,), estimate, 3, dimensions=3)


def density(aperture: Aperture, x):
    """What arrives at x, a Point2f in units of wavelength times f-number, right and up; its integral is 1."""
    area = math.pi / 4
    if not aperture.blades:
        v = math.pi * dr.norm(x)
        return area * dr.square(dr.select(v < 1e-3, 1.0, 2 * bessel_j1(v) / dr.maximum(v, 1e-3)))
    return dr.squared_norm(_transform(aperture.corners, 2 * math.pi * x)) / area


def _transform(corners: np.ndarray, k):
    """The Fourier transform of a polygon, as (real, imaginary), by its edges: Green's theorem (Lee & Mittra 1983)."""
    real, imaginary = mi.Float(0), mi.Float(0)
    square = dr.squared_norm(k)
    for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        edge, middle = b - a, (a + b) / 2
        half = 0.5 * (k.x * float(edge[0]) + k.y * float(edge[1]))
        phase = k.x * float(middle[0]) + k.y * float(middle[1])
        weight = (k.x * float(edge[1]) - k.y * float(edge[0])) * dr.select(
            dr.abs(half) < 1e-4, 1.0, dr.sin(half) / half
        )
        # i·e^{−i·phase}/k² = (sin phase + i·cos phase)/k²
        real += weight * dr.sin(phase)
        imaginary += weight * dr.cos(phase)
    return dr.select(square < 1e-6, mi.Point2f(math.pi / 4, 0.0), mi.Point2f(real, imaginary) / square)


def bessel_j1(x):
    """J₁ of x ≥ 0, to 1e-7 (Abramowitz & Stegun 1964, 9.4.4 and 9.4.6)."""
    t = dr.square(x / 3)
    near = x * _polynomial(t, (0.5, -0.56249985, 0.21093573, -0.03954289, 0.00443319, -0.00031761, 0.00001109))
    s = 3 / dr.maximum(x, 3.0)
    size = _polynomial(s, (0.79788456, 0.00000156, 0.01659667, 0.00017105, -0.00249511, 0.00113653, -0.00020033))
    phase = x + _polynomial(s, (-2.35619449, 0.12499612, 0.00005650, -0.00637879, 0.00074348, 0.00079824, -0.00029166))
    return dr.select(x <= 3, near, size * dr.cos(phase) / dr.sqrt(dr.maximum(x, 3.0)))


def _polynomial(x, coefficients):
    value = mi.Float(0)
    for c in reversed(coefficients):
        value = value * x + c
    return value
