"""Fits linearly transformed cosines to the material's specular lobe, and writes the table that the shader reads.

    python -m lightmeter.realtime.effects.ltc_area_light.fit

A linearly transformed cosine is the density D(ω) = cos(ωₒ)/π·|det M⁻¹|/|M⁻¹ω|³, ωₒ = M⁻¹ω/|M⁻¹ω|, of a clamped cosine
whose directions went through M (Heitz, Dupuy, Hill & Neubelt 2016, eq. 1). Here it is cut at the surface's horizon and
scaled to what is left, so that it returns the lobe's albedo E. The fit makes the total variation ½·∫|f/E − D| as small
as it can: over no region do two densities differ by more, so that, times E, it bounds the error under *any* light of
radiance 1, whatever its outline.

M⁻¹ = T·diag(1/α, 1/(α·√(μ² + α²(1 − μ²))), 1)·R⁻¹ with μ = n·v, where R turns z to the view's mirror direction. The two
factors on the right are place and widths of a narrow lobe. What is left, T, changes slowly with roughness and angle and
can be interpolated; of M⁻¹ itself, which the paper tabulates, a narrow lobe would be lost between two rows of a table
this small. T's entries 00, 02, 20 and 22 over 11 are kept, the others are 0.
"""

import json
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.optimize import minimize

from lightmeter.scenes.optics import microfacet

TABLE = Path(__file__).parent / "table.json"
SIDE = 32
SAMPLES = 32
"""Along each of two dimensions, of the lobe and of the cosine."""

FINE = 256
"""Along each of two dimensions, for the albedos."""

STEP = 0.1
"""Of the search's first simplex."""

SMALLEST_COSINE = 1e-3
"""Of the view: at 0 the lobe has no limit that the table could hold."""


@dataclass(frozen=True, eq=False)
class Lobe:
    """GGX with height-correlated Smith, F = 1, times n·l, for one α and one view in the xz-plane.

    Attributes:
        directions, weights: (3, n) and (n,), above the horizon: Σ w·g is the mean of g over the lobe.
        albedo, grazing: ∫f·(n·l) and ∫f·(n·l)·(1 − v·h)⁵ over the hemisphere; the second is what Schlick's Fresnel
            adds for F90.
    """

    alpha: float
    view: np.ndarray
    directions: np.ndarray
    weights: np.ndarray
    albedo: float
    grazing: float

    @classmethod
    def of(cls, alpha: float, cosine: float, samples: int = SAMPLES, fine: int = FINE) -> "Lobe":
        """The lobe at a cosine of the view; `fine`² samples give the albedos."""
        cosine = max(cosine, SMALLEST_COSINE)
        view = np.array([math.sqrt(1 - cosine**2), 0.0, cosine])
        directions, h, weights = _mirrored(alpha, view, fine)
        albedo, grazing = float(weights.sum()), float((weights * (1 - view @ h) ** 5).sum())
        directions, _, weights = _mirrored(alpha, view, samples)
        return cls(alpha, view, directions, weights / albedo, albedo, grazing)

    def density(self, directions: np.ndarray) -> np.ndarray:
        """f·(n·l)/E in directions (3, n) above the horizon."""
        return _value_and_density(self.alpha, self.view, directions)[0] / self.albedo


def grid(samples: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points of a square and their weights, (samples²,) each: the middles of cells that narrow where u1 nears 1.

    There the lobe's long tail lies, which evenly spread points would miss.
    """
    middles = (np.arange(samples) + 0.5) / samples
    s, u2 = np.meshgrid(middles, middles, indexing="ij")
    return (1 - (1 - s) ** 2).ravel(), u2.ravel(), (2 * (1 - s)).ravel() / samples**2


def _mirrored(alpha: float, view: np.ndarray, samples: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The view mirrored at visible normals (Heitz 2018), above the horizon; the normals; weights that add up to E."""
    u1, u2, weights = grid(samples)
    views = np.broadcast_to(view[:, None], (3, len(u1)))
    h = microfacet.sample_visible_normal(views, alpha, u1, u2, lambda *c: np.stack(np.broadcast_arrays(*c)))
    directions = 2 * (view @ h) * h - view[:, None]
    above = directions[2] > 0
    directions = directions[:, above]
    value, density = _value_and_density(alpha, view, directions)
    return directions, h[:, above], weights[above] * value / density


def _value_and_density(alpha: float, view: np.ndarray, directions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """f·(n·l) with F = 1, and the density of mirrored visible normals (Heitz 2018, eq. 17)."""
    h = directions + view[:, None]
    h /= np.linalg.norm(h, axis=0)
    n_dot_l, n_dot_v = directions[2], view[2]
    d = microfacet.d_ggx(h[2], h[0] ** 2 + h[1] ** 2, alpha)
    lit = np.maximum(n_dot_l, 1e-12)
    value = d * microfacet.v_smith_ggx_correlated(n_dot_v, lit, alpha) * lit
    masked = n_dot_v + math.sqrt(n_dot_v**2 * (1 - alpha**2) + alpha**2)
    return np.where(n_dot_l > 0, value, 0), np.where(n_dot_l > 0, 0.5 * d / masked, 0)


@dataclass(frozen=True, eq=False)
class Cosine:
    """A linearly transformed cosine. `matrix` (3, 3) brings the clamped cosine's directions to the lobe's."""

    matrix: np.ndarray

    @classmethod
    def of(cls, lobe: Lobe, entries: np.ndarray) -> "Cosine":
        """The cosine near a lobe that the four entries of T stand for."""
        a, b, c, d = entries[:4]
        (s, _, mu), alpha = lobe.view, lobe.alpha
        turn = np.array([[mu, 0, -s], [0, 1, 0], [s, 0, mu]])
        widths = np.diag([alpha, alpha * math.sqrt(mu**2 + alpha**2 * (1 - mu**2)), 1])
        return cls(turn @ widths @ np.linalg.inv(np.array([[a, 0, b], [0, 1, 0], [c, 0, d]])))

    @property
    def above(self) -> float:
        """The share of it above the surface's horizon: two half spaces at an angle γ share (1 + cos γ)/2."""
        row = self.matrix[2]
        return float(1 + row[2] / np.linalg.norm(row)) / 2

    def density(self, directions: np.ndarray) -> np.ndarray:
        """In directions (3, n), scaled to 1 over the hemisphere; 0 below the horizon."""
        inverse = np.linalg.inv(self.matrix)
        back = inverse @ directions
        length = np.linalg.norm(back, axis=0)
        value = np.maximum(back[2], 0) / np.pi * abs(np.linalg.det(inverse)) / length**4
        return np.where(directions[2] > 0, value / self.above, 0)

    def sample(self, samples: int) -> tuple[np.ndarray, np.ndarray]:
        """Directions (3, n) above the horizon and weights (n,) that add up to 1."""
        u1, u2, weights = grid(samples)
        radius, turn = np.sqrt(u1), 2 * np.pi * u2
        out = self.matrix @ np.stack([radius * np.cos(turn), radius * np.sin(turn), np.sqrt(1 - u1)])
        out = out / np.linalg.norm(out, axis=0)
        return out[:, out[2] > 0], weights[out[2] > 0] / self.above


def variation(lobe: Lobe, cosine: Cosine, samples: int = SAMPLES) -> float:
    """½·∫|p − q|dω of the two densities, 0…1: the mean over p of what q lacks of it, and the other way round.

    Both are the same number; their mean is the better estimate of it.
    """
    lacking = 1 - cosine.density(lobe.directions) / np.maximum(lobe.density(lobe.directions), 1e-300)
    directions, weights = cosine.sample(samples)
    exceeding = 1 - lobe.density(directions) / np.maximum(cosine.density(directions), 1e-300)
    return float(lobe.weights @ np.maximum(lacking, 0) + weights @ np.maximum(exceeding, 0)) / 2


def fit(lobe: Lobe, starts: list[np.ndarray]) -> np.ndarray:
    """T's four entries for the nearest cosine; the best of what the search finds from several starts."""

    def badness(numbers: np.ndarray) -> float:
        return variation(lobe, Cosine.of(lobe, _entries(numbers)))

    found = []
    for start in starts:
        numbers = np.array([math.log(start[0]), start[1], start[2], math.log(start[3])])
        simplex = np.concatenate([numbers[None], numbers + STEP * np.eye(4)])
        options = {"maxiter": 300, "xatol": 1e-4, "fatol": 1e-5, "initial_simplex": simplex}
        found.append(minimize(badness, numbers, method="Nelder-Mead", options=options))
    return _entries(min(found, key=lambda result: result.fun).x)


def _entries(numbers: np.ndarray) -> np.ndarray:
    """The diagonal ones are positive, and searched for by their logarithms."""
    a, b, c, d = numbers
    return np.array([math.exp(a), b, c, math.exp(d)])


def roughness_of(row: float, side: int = SIDE) -> float:
    """The table's roughness grows evenly from 0 to 1."""
    return row / (side - 1)


def cosine_of(column: float, side: int = SIDE) -> float:
    """n·v = 1 − x², x evenly from 0 to 1."""
    return 1 - (column / (side - 1)) ** 2


def make_table(side: int = SIDE, report=lambda _row: None) -> np.ndarray:
    """(side, side, 6): T's four entries; the albedo and its grazing part, both over the cosine's share above."""
    table = np.zeros((side, side, 6))
    narrow = np.array([1.0, 0.0, 0.0, 2.0])  # what a narrow lobe seen from above tends to
    for row in range(side):
        report(row)
        alpha = float(microfacet.alpha_from_roughness(roughness_of(row, side)))
        for column in range(side):
            # From the neighbours' fits, so that the table stays smooth.
            starts = [table[row, column - 1, :4]] if column else []
            starts += [table[row - 1, column, :4]] if row else []
            lobe = Lobe.of(alpha, cosine_of(column, side))
            table[row, column, :4] = fit(lobe, starts or [narrow])
            above = Cosine.of(lobe, table[row, column]).above
            table[row, column, 4:] = lobe.albedo / above, lobe.grazing / above
    return table


if __name__ == "__main__":
    rounded = [[[float(f"{x:.6g}") for x in cell] for cell in row] for row in make_table(report=print)]
    TABLE.write_text(json.dumps({"table": rounded}, separators=(",", ":")) + "\n", encoding="utf-8")
