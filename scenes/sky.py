"""A clear sky with its sun over a grey ground, as a latitude-longitude map (Preetham, Shirley & Smits 1999, A Practical
Analytic Model for Daylight).

A radiance of 1 stands for 10,000 cd/m². The sun is a disk of 0.53° with the energy that the air leaves of it.
"""

import numpy as np

from lightmeter.scenes.model import Image
from lightmeter.scenes.optics import environment as optics

HEIGHT = 512
AZIMUTH = np.pi / 4
"""Where the sun stands before the map is turned: between +X and +Z."""
SUN_ANGLE = np.radians(0.53) / 2
SUN_ILLUMINANCE = 12.8
"""Above the air, in 10,000 lx."""
ALBEDO = 0.2
"""Of the ground."""

PEREZ = np.array(
    [
        [[0.1787, -1.4630], [-0.3554, 0.4275], [-0.0227, 5.3251], [0.1206, -2.5771], [-0.0670, 0.3703]],
        [[-0.0193, -0.2592], [-0.0665, 0.0008], [-0.0004, 0.2125], [-0.0641, -0.8989], [-0.0033, 0.0452]],
        [[-0.0167, -0.2608], [-0.0950, 0.0092], [-0.0079, 0.2102], [-0.0441, -1.6537], [-0.0109, 0.0529]],
    ]
)
"""Slope and offset over turbidity of A…E, for Y, x and y (appendix A.2)."""

ZENITH = np.array(
    [
        [
            [0.00166, -0.00375, 0.00209, 0],
            [-0.02903, 0.06377, -0.03202, 0.00394],
            [0.11693, -0.21196, 0.06052, 0.25886],
        ],
        [
            [0.00275, -0.00610, 0.00317, 0],
            [-0.04214, 0.08970, -0.04153, 0.00516],
            [0.15346, -0.26756, 0.06670, 0.26688],
        ],
    ]
)
"""Of the zenith's x and y: powers 2, 1, 0 of turbidity by powers 3…0 of the sun's angle from it (appendix A.2)."""

RGB_FROM_XYZ = np.array(
    [[3.2404542, -1.5371385, -0.4985314], [-0.9692660, 1.8760108, 0.0415560], [0.0556434, -0.2040259, 1.0572252]]
)
"""Rec. 709 with D65 (IEC 61966-2-1)."""

WAVELENGTHS = np.array([0.61, 0.55, 0.465])
"""µm: where the air's transmittance for red, green and blue is taken."""
OZONE = np.array([0.12, 0.085, 0.008])
"""1/cm there (Preetham et al. 1999, table 2)."""


def sky(elevation: float = 45.0, turbidity: float = 3.0, height: int = HEIGHT) -> Image:
    """The map, (height, 2·height, 3).

    Args:
        elevation: of the sun above the horizon, degrees, above 0 and up to 90.
        turbidity: how hazy it is: 2 (clear) to 10 (hazy).
    """
    u, v = np.meshgrid((np.arange(2 * height) + 0.5) / (2 * height), (np.arange(height) + 0.5) / height)
    directions = np.stack(optics.direction_at(u, v, 0.0))
    zenith_angle = np.radians(90.0 - elevation)
    towards_sun = np.array(
        [np.sin(zenith_angle) * np.cos(AZIMUTH), np.cos(zenith_angle), np.sin(zenith_angle) * np.sin(AZIMUTH)]
    )
    above = directions[1] > 0
    texels = np.zeros((height, 2 * height, 3))
    texels[above] = _dome(directions[:, above], towards_sun, zenith_angle, turbidity)
    edges = np.cos(np.pi * np.arange(height + 1) / height)
    solid_angle = ((edges[:-1] - edges[1:]) * np.pi / height)[:, None]
    from_sky = np.sum(texels * (np.maximum(directions[1], 0) * solid_angle)[..., None], axis=(0, 1))
    share = _disk(towards_sun, height) * above
    sun = SUN_ILLUMINANCE * transmittance(zenith_angle, turbidity)
    texels += (share / share.sum() / solid_angle)[..., None] * sun
    texels[~above] = ALBEDO / np.pi * (from_sky + sun * np.cos(zenith_angle))
    return Image(texels.astype(np.float32), "sky")


def _dome(directions: np.ndarray, towards_sun: np.ndarray, zenith_angle: float, turbidity: float) -> np.ndarray:
    """(n, 3) radiance of the sky without its sun, of (3, n) directions above the horizon."""
    cosine = np.maximum(directions[1], 1e-3)
    cos_gamma = np.clip(towards_sun @ directions, -1, 1)
    gamma = np.arccos(cos_gamma)
    chi = (4 / 9 - turbidity / 120) * (np.pi - 2 * zenith_angle)
    luminance = (4.0453 * turbidity - 4.9710) * np.tan(chi) - 0.2155 * turbidity + 2.4192
    powers = zenith_angle ** np.array([3, 2, 1, 0])
    chroma = np.array([turbidity**2, turbidity, 1.0]) @ ZENITH @ powers
    found = []
    for coefficients, at_zenith in zip(PEREZ, (luminance, *chroma), strict=True):
        a, b, c, d, e = coefficients @ [turbidity, 1.0]

        def distribution(cos_view, angle, a=a, b=b, c=c, d=d, e=e):
            return (1 + a * np.exp(b / cos_view)) * (1 + c * np.exp(d * angle) + e * np.cos(angle) ** 2)

        found.append(at_zenith * distribution(cosine, gamma) / distribution(1.0, zenith_angle))
    y_luminance, x, y = found
    xyz = np.stack([x / y * y_luminance, y_luminance, (1 - x - y) / y * y_luminance])
    # kcd/m² to tens of them; what lies outside of Rec. 709 is cut.
    return np.maximum(RGB_FROM_XYZ @ xyz, 0).T / 10


def transmittance(zenith_angle: float, turbidity: float) -> np.ndarray:
    """(3,) what the air leaves of the sun: Rayleigh's and Ångström's scattering, ozone (appendix A.1)."""
    degrees = np.degrees(zenith_angle)
    mass = 1 / (np.cos(zenith_angle) + 0.15 * (93.885 - degrees) ** -1.253)
    haze = 0.04608 * turbidity - 0.04586
    return np.exp(-mass * (0.008735 * WAVELENGTHS**-4.08 + haze * WAVELENGTHS**-1.3 + OZONE * 0.35))


def _disk(towards_sun: np.ndarray, height: int, points: int = 8) -> np.ndarray:
    """(height, 2·height) solid angle of the sun within each texel, up to a factor; never nothing at all."""
    steps = ((np.arange(points) + 0.5) / points - 0.5) / height
    covered = np.zeros((height, 2 * height))
    row = int(np.arccos(towards_sun[1]) / np.pi * height)
    reach = int(np.ceil(SUN_ANGLE / np.pi * height)) + 1
    rows = np.arange(max(row - reach, 0), min(row + reach + 1, height))
    u, v = (np.arange(2 * height) + 0.5) / (2 * height), (rows + 0.5) / height
    for along_u in steps / 2:
        for along_v in steps:
            at_u, at_v = np.meshgrid(u + along_u, v + along_v)
            d = np.stack(optics.direction_at(at_u, at_v, 0.0))
            inside = np.tensordot(towards_sun, d, 1) > np.cos(SUN_ANGLE)
            covered[rows] += inside * np.sin(np.pi * (v + along_v))[:, None]
    if not covered.any():
        column = int((0.5 + AZIMUTH / (2 * np.pi)) * 2 * height)
        covered[min(row, height - 1), column] = 1.0
    return covered
