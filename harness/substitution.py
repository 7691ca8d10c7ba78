"""Substitution: the composition at some points, with any of its terms exact.

    L = emission + Σ_l direct_l · visibility_l + environment · environment_visibility + indirect

A *player* is what can be made exact: an effect, or a term that no effect approximates. A *slot* is a summand of L with
its one or two players: an image for each set of them that is exact. Lights with the same two players share a slot, so
that however many lights there are, only four sums are kept.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from lightmeter.exact_batch import ExactBatch
from lightmeter.realtime.graph import FACTORS, Plan
from lightmeter.realtime.renderer import Capture
from lightmeter.scenes.terms import TERMS
from lightmeter.stacking import mean_samples

Ratios = Mapping[int | str, np.ndarray]
"""Exact visibility, (n, H, W, 3), by light or "environment"."""


@dataclass(frozen=True)
class Slot:
    """A summand of the composition.

    Attributes:
        term: "direct", "environment", "indirect" or "transmission".
        players: whose exactness it depends on: the radiance's and, where it has a visibility, that one's.
        lights: for "direct": indices into `Scene.all_lights`.
    """

    term: str
    players: tuple[str, ...]
    lights: tuple[int, ...] = ()

    @property
    def sets(self) -> range:
        """Every set of exact players: bit i set, player i is exact."""
        return range(1 << len(self.players))

    def exact_set(self, exact: Collection[str]) -> int:
        """The set that makes exact those of its players that are among `exact`."""
        return sum(1 << i for i, player in enumerate(self.players) if player in exact)


def players_of(plan: Plan, term: str, light: int | None = None) -> tuple[str, ...]:
    """Who stands for a term (of a light): the effects that give it, else the term itself.

    Only terms of the G-buffer have more than one: each effect changes another part of it.
    """
    if TERMS[term].scope == "gbuffer":
        return tuple(name for name in plan.effects_of(term) if not plan.filters_display(name)) or (term,)
    return (next((s.effect for s in plan.steps if term in s.writes and s.light == light), term),)


def slots(plan: Plan) -> tuple[Slot, ...]:
    """The summands that the scene has, in order."""
    missing = plan.missing

    def players(term: str, light: int | None = None) -> tuple[str, ...]:
        factors = [t for t in (term, FACTORS.get(term)) if t is not None and t not in missing]
        return tuple(dict.fromkeys(name for factor in factors for name in players_of(plan, factor, light)))

    found: list[Slot] = []
    if "direct" not in missing:
        lights: dict[tuple[str, ...], list[int]] = {}
        for light in range(len(plan.scene.all_lights)):
            lights.setdefault(players("direct", light), []).append(light)
        found += [Slot("direct", names, tuple(those)) for names, those in lights.items()]
    whole = ("environment", "indirect", "transmission")
    return (*found, *(Slot(term, players(term)) for term in whole if term not in missing))


def players(plan: Plan) -> dict[str, tuple[str, ...]]:
    """Every player of the scene-linear image to the terms that become exact with it, as they are drawn."""
    missing = plan.missing
    found: dict[str, dict[str, None]] = {}
    for term in (t for t in TERMS if TERMS[t].scope != "display" and t not in missing):
        of_lights = TERMS[term].scope == "light"
        for light in range(len(plan.scene.all_lights)) if of_lights else (None,):
            for name in players_of(plan, term, light):
                found.setdefault(name, {}).setdefault(term)
    drawn = list(dict.fromkeys(step.effect for step in plan.steps))
    return {n: tuple(found[n]) for n in sorted(found, key=lambda n: drawn.index(n) if n in drawn else len(drawn))}


def exact_ratios(batches: Sequence[ExactBatch]) -> Ratios:
    """Visibilities pooled over batches at the same points, ΣA/ΣB: a mean of noisy ratios would be biased."""
    keys: list[int | str] = [*batches[0].direct]
    if batches[0].environment is not None:
        keys.append("environment")
    return {
        key: _ratio(*(sum(_factors(b, key)[i].astype(np.float64) for b in batches) for i in (0, 1))) for key in keys
    }


def _factors(batch: ExactBatch, key: int | str) -> tuple[np.ndarray, np.ndarray]:
    """A and B of a light or of the environment."""
    if isinstance(key, int):
        return batch.shadowed[key], batch.direct[key]
    assert batch.environment is not None
    assert batch.environment_shadowed is not None
    return batch.environment_shadowed, batch.environment


def slot_image(slot: Slot, which: int, captures: Sequence[Capture], exact: ExactBatch, ratios: Ratios) -> np.ndarray:
    """(H, W, 3) float32: a slot with the players in the set `which` exact, averaged over the n points of a pixel.

    Args:
        captures: what the effects gave, at each of the n points.
        exact: what the oracles gave at the same points.
        ratios: exact visibilities, for an exact visibility of an approximate radiance.
    """
    shape = exact.emission.shape
    total = np.zeros(shape, np.float64)
    for light in slot.lights or (None,):
        total += _summand(slot, which, light, captures, exact, ratios, shape)
    return mean_samples(total).astype(np.float32)


def _summand(slot, which, light, captures, exact, ratios, shape) -> np.ndarray:
    """One light's part of a slot, or the frame's: (n, H, W, 3)."""
    everything = which == len(slot.sets) - 1
    if everything:
        return _transported(slot, light, exact)
    radiance_exact = bool(which & 1)
    if radiance_exact:
        radiance = exact.direct[light] if slot.term == "direct" else exact.environment
    else:
        radiance = _buffer(captures, slot.term, light, 0.0, shape)
    factor = FACTORS.get(slot.term)
    if factor is None:
        return radiance
    if which & 2:
        return radiance * ratios["environment" if light is None else light]
    return radiance * _buffer(captures, factor, light, 1.0, shape)


def _transported(slot: Slot, light: int | None, exact: ExactBatch) -> np.ndarray:
    """A itself: what arrives with radiance and visibility exact."""
    if slot.term == "direct":
        return exact.shadowed[light]
    found = exact.environment_shadowed if slot.term == "environment" else getattr(exact, slot.term)
    assert found is not None, "the scene has what its slots are of"
    return found


def _buffer(captures: Sequence[Capture], term: str, light: int | None, neutral: float, shape) -> np.ndarray:
    """An effect's buffer at every point; the term's neutral value where no effect gives it."""
    found = [capture.frame.get(term) if light is None else getattr(capture, term).get(light) for capture in captures]
    there = [image for image in found if image is not None]
    return np.stack(there) if there else np.full(shape, neutral, np.float32)


def _ratio(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """a / b as float32; 1 where nothing arrives even unshadowed."""
    return np.divide(a, b, out=np.ones_like(a), where=b > 0).astype(np.float32)
