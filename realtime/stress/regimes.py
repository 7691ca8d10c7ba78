"""The regimes that lanes of inputs are told apart by: a decade of α, a grazing angle, a normal that is no unit."""

from dataclasses import dataclass

import numpy as np

from ..twin import Argument
from .kinds import UNIT_SLACK, Domain, domain_of

SMALLEST_NORMAL = float(np.finfo(np.float32).smallest_normal)
GRAZING = 1e-3
NO_LENGTH = 1e-3
HEAD_ON = 1 - 1e-6
ALPHA_EDGES = (1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1)

REGIMES = {
    "ordinary": "every argument in its declared range, no extreme",
    **{f"α ≥ {low:g}": f"α from {low:g} to {10 * low:g}" for low in reversed(ALPHA_EDGES)},
    "grazing": f"a cosine above 0 and below {GRAZING:g}",
    "head-on": "a cosine within 1e-6 of 1",
    "cosine ≤ 0": "a cosine of 0 or less",
    "cosine > 1": "a cosine above 1, as rounding makes it",
    "opposite": "two directions opposite to within 1e-6",
    "not unit": "a direction whose length is not 1",
    "zero vector": f"a direction of length 0, or below {NO_LENGTH:g}",
    "black or white": "a reflectance or share of 0 or 1",
    "beyond 0…1": "a reflectance or share outside 0…1",
    "index near 1": "an index of refraction within 1e-3 of 1",
    "index below 1": "an index of refraction below 1",
    "tiny": "an intensity or distance below 1e-5",
    "huge": "an intensity or distance above 1e5",
    "denormal": "a number too small for float32's full digits",
}
"""Name to what it means, in the order of the report's columns."""


@dataclass(frozen=True)
class Marks:
    """Which lanes lie in which regime.

    Attributes:
        lanes: regime to a mask (n,). A lane counts where only the arguments that make it so leave their range.
        declared: every argument in its declared range (n,).
        alpha, cosine: α and the least |cosine| of each lane (n,); None where the function has none.
    """

    lanes: dict[str, np.ndarray]
    declared: np.ndarray
    alpha: np.ndarray | None
    cosine: np.ndarray | None

    @property
    def usual(self) -> np.ndarray:
        """Every argument in its declared range, α aside, which may be smaller (n,)."""
        return np.any([self.declared, *(mask for r, mask in self.lanes.items() if r.startswith("α"))], axis=0)


def marks_of(arguments: list[Argument], inputs: list[np.ndarray]) -> Marks:
    """The regimes of lanes, (components, n) for each argument."""
    domains = [domain_of(argument) for argument in arguments]
    outside = np.array([_outside(d, x) for d, x in zip(domains, inputs, strict=True)])
    strays = outside.sum(axis=0)
    found: dict[str, np.ndarray] = {}

    def mark(regime: str, members: tuple[int, ...], mask: np.ndarray) -> None:
        alone = mask & (strays == outside[list(members)].sum(axis=0))
        found[regime] = found.get(regime, np.zeros(len(strays), bool)) | alone

    alpha, cosines = None, []
    for i, (domain, x) in enumerate(zip(domains, inputs, strict=True)):
        own = (i,)
        if domain.kind in ("alpha", "roughness"):
            alpha = x[0] if domain.kind == "alpha" else x[0] ** 2
            for low in ALPHA_EDGES:
                mark(f"α ≥ {low:g}", own, (alpha >= low * (1 - 1e-6)) & (alpha < 10 * low * (1 + (low == 0.1))))
        elif domain.kind == "cosine":
            cosines.append((own, x[0]))
        elif domain.kind in ("share", "colour"):
            mark("black or white", (), ((x == 0) | (x == 1)).any(axis=0))
            mark("beyond 0…1", own, ((x < 0) | (x > 1)).any(axis=0))
        elif domain.kind == "index":
            mark("index near 1", own, ((np.abs(x - 1) < 1e-3) & (x >= 1)).any(axis=0))
            mark("index below 1", own, (x < 1).any(axis=0))
        elif domain.kind in ("intensity", "distance"):
            size = np.linalg.norm(x, axis=0)
            mark("tiny", own, (size < 1e-5) & (size >= SMALLEST_NORMAL))
            mark("huge", own, size > 1e5)
        elif domain.kind == "direction":
            size = np.linalg.norm(x, axis=0)
            mark("not unit", own, outside[i] & (size >= NO_LENGTH))
            mark("zero vector", own, size < NO_LENGTH)
        if domain.kind != "fixed":
            mark("denormal", own, ((x != 0) & (np.abs(x) < SMALLEST_NORMAL)).any(axis=0))
    cosines += _between_directions(arguments, domains, inputs, mark)
    for members, cosine in cosines:
        mark("grazing", members, (cosine >= SMALLEST_NORMAL) & (cosine < GRAZING))
        mark("head-on", members, (cosine > HEAD_ON) & (cosine <= 1))
        mark("cosine ≤ 0", members, cosine <= 0)
        mark("cosine > 1", members, (cosine > 1) & (len(members) > 0))
    declared = strays == 0
    extreme = [mask for regime, mask in found.items() if not regime.startswith("α")]
    plain = declared & ~np.any([np.zeros_like(declared), *extreme], axis=0)
    found["ordinary"] = plain
    least = np.min([np.abs(c) for _, c in cosines], axis=0) if cosines else None
    return Marks({r: found[r] for r in REGIMES if r in found}, declared, alpha, least)


def _outside(domain: Domain, x: np.ndarray) -> np.ndarray:
    """Lanes whose argument leaves its declared range."""
    if domain.kind == "fixed":
        return np.zeros(x.shape[1], bool)
    if domain.kind == "direction":
        return np.abs(np.linalg.norm(x, axis=0) - 1) > UNIT_SLACK
    small = (x != 0) & (np.abs(x) < SMALLEST_NORMAL)
    return ((x < domain.low) | (x > domain.high) | small).any(axis=0)


def _between_directions(arguments, domains, inputs, mark) -> list[tuple[tuple[int, ...], np.ndarray]]:
    """Cosines of the first direction, a normal, with the others; opposite ones are marked."""
    places = [i for i, d in enumerate(domains) if d.kind == "direction"]
    if len(places) < 2:
        return []
    unit = {i: inputs[i] / np.maximum(np.linalg.norm(inputs[i], axis=0), 1e-300) for i in places}
    for a in places:
        for b in places:
            if a < b:
                mark("opposite", (), (unit[a] * unit[b]).sum(axis=0) < -HEAD_ON)
    normal = next((i for i in places if arguments[i].name in ("n", "normal")), places[0])
    return [((), (unit[normal] * unit[i]).sum(axis=0)) for i in places if i != normal]
