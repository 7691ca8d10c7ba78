"""Light from all over the hemisphere on a point: directions and weights that resolve a lobe of any width.

∫ f·(n·l) dl is taken over half vectors, dl = 4·(v·h) dh, around the normal n = +z. Every lobe is in their midst: a
microfacet's, whatever its α, and a mirror's; and none needs to say how wide it is.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np

NEAREST, FURTHEST = -16.0, 14.0
"""ln of the angle over what is left of it to the horizon: 10⁻⁷ of the way from the normal, and 10⁻⁶ from the horizon.
What lies within is left out: (10⁻⁷/α)² of a lobe, and 10⁻⁶ of what is even."""
NARROWEST = 1e-3
"""The width of the narrowest ridge that a grain gives a lobe: the smallest α."""


@dataclass(frozen=True)
class Rule:
    """How fine the directions lie.

    Attributes:
        step: of the logarithm of the angle from the normal, by which the trapezoidal rule goes.
        turns: Gauss's nodes in azimuth, from each place where the integrand turns fast to the middle between two.
    """

    step: float
    turns: int


SEARCH, COARSE, FINE = Rule(0.6, 12), Rule(0.35, 20), Rule(0.2, 48)
"""`FINE` gives the albedos of GGX and of Beckmann's lobe to 2·10⁻⁸, of a mirror cosine's power from 3 up to 2·10⁻⁶,
`COARSE` to 10⁻⁸, 10⁻⁵ and 10⁻⁴, `SEARCH` to 4·10⁻³, for α and n·v from 10⁻³; held against twice as fine a rule over a
wider range. A power below 2 ends with a bend that no node lies at: 3·10⁻³, 2·10⁻² and 3·10⁻²."""


def light_from_everywhere(cosine: float, rule: Rule, turn: float | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Directions l (3, N), unit, above n = +z, and weights (N,) in sr, of which Σ f·(n·l)·weight is the albedo.

    Nodes in azimuth crowd where the way to the horizon bends, within n·v of a right angle to the view, and along and
    across a grain.

    Args:
        cosine: n·v, above 0; v = (√(1 − n·v²), 0, n·v).
        turn: azimuth of a grain in radians; None where the lobe is the same on both sides of the view.
    """
    sine = np.sqrt(1 - cosine * cosine)
    if turn is None:  # both sides alike: half a turn counts twice
        corner = np.array([np.pi / 2, np.pi / 2])
        phi, azimuth = _graded(corner, np.array([0.0, np.pi]), max(cosine, 1e-6), rule.turns)
        azimuth = 2 * azimuth
    else:
        corners = np.sort(np.mod([np.pi / 2, 3 * np.pi / 2, *(turn + np.arange(4) * np.pi / 2)], 2 * np.pi))
        middle = (corners + np.append(corners[1:], corners[0] + 2 * np.pi)) / 2
        ends = np.concatenate([middle, np.append(middle[-1] - 2 * np.pi, middle[:-1])])
        phi, azimuth = _graded(np.tile(corners, 2), ends, min(cosine, NARROWEST), rule.turns)
    # n·l = 0 where 2θ_h = 90° + atan(tan θ_v·cos φ).
    horizon = np.pi / 4 + np.arctan2(sine * np.cos(phi), cosine) / 2
    share = 1 / (1 + np.exp(-np.arange(NEAREST, FURTHEST, rule.step)))[:, None]
    theta = horizon * share
    solid = horizon * share * (1 - share) * rule.step * np.sin(theta) * azimuth
    half = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta) + 0 * phi])
    view = np.array([sine, 0.0, cosine])[:, None, None]
    v_dot_h = np.sum(view * half, axis=0)
    light = 2 * v_dot_h * half - view
    return light.reshape(3, -1), (4 * v_dot_h * solid).ravel()


@cache
def _gauss(count: int) -> tuple[np.ndarray, np.ndarray]:
    return np.polynomial.legendre.leggauss(count)


def _graded(starts: np.ndarray, ends: np.ndarray, width: float, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Nodes and weights from each start to its end, evenly in asinh of the distance over `width`."""
    nodes, weights = _gauss(count)
    way = (ends - starts)[:, None]
    span = np.arcsinh(np.abs(way) / width)
    away = span * (nodes + 1) / 2
    distance = np.sign(way) * width * np.sinh(away)
    return (starts[:, None] + distance).ravel(), (width * np.cosh(away) * span * weights / 2).ravel()
