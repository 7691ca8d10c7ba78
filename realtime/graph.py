"""The frame graph, compiled in plain Python: which effects draw what, in which order, and what is left out and why."""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

from lightmeter.scenes.features import missing_terms
from lightmeter.scenes.model import Scene
from lightmeter.scenes.terms import TERMS
from lightmeter.scenes.true_surface import true_surface

from .effect import Effect, EffectError, Knobs, nearest

FACTORS = {"direct": "visibility", "environment": "environment_visibility"}
"""Which visibility a radiance is multiplied with."""

DISPLAY_TERMS = tuple(term.name for term in TERMS.values() if term.scope == "display")
FRAME_TERMS = ("environment", "environment_visibility", "indirect", "transmission")
DRAWN_TERMS = ("direct", "visibility", *FRAME_TERMS, *DISPLAY_TERMS)


@dataclass(frozen=True)
class Choice:
    """What the user asked for.

    Attributes:
        only: take just these effects; empty: all.
        without: leave these out; another effect takes the place of one only where it is asked for.
        use: prefer these among effects for the same term.
        settings: knob values by effect and knob.
    """

    only: tuple[str, ...] = ()
    without: tuple[str, ...] = ()
    use: tuple[str, ...] = ()
    settings: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)


@dataclass(frozen=True)
class LeftOut:
    """Something that costs nothing in this frame, and the reason."""

    what: str
    why: str


@dataclass(frozen=True)
class Step:
    """One effect drawing what it writes, for one light (its index in `Scene.all_lights`) or for the frame."""

    effect: str
    writes: tuple[str, ...]
    reads: tuple[str, ...] = ()
    light: int | None = None

    @property
    def of_display(self) -> bool:
        """Whether it works on the finished scene-linear image, or what is made of it; so do filters of code values."""
        return self.writes[0] in (*DISPLAY_TERMS, "coverage")


@dataclass(frozen=True, eq=False)
class Plan:
    """A compiled frame.

    Attributes:
        scene: as it is drawn.
        true_scene: the same with its true surface; `scene` itself where no effect draws another.
        missing: the terms that play no part, each with the reason.
        steps: what is drawn after the G-buffer, in order.
        channels: the G-buffer channels that the steps read.
        effects: the effects that take part, with every knob's value.
        left_out: what does not, and why.
        not_approximated: terms that the scene has and no effect gives.
    """

    scene: Scene
    steps: tuple[Step, ...]
    channels: frozenset[str]
    effects: Mapping[str, tuple[Effect, Knobs]]
    left_out: tuple[LeftOut, ...]
    not_approximated: tuple[str, ...]
    true_scene: Scene
    missing: Mapping[str, str]

    def stored(self, exact: Collection[str] = ()) -> dict[str, str]:
        """The formats of the G-buffer's channels that effects ask for, but for those of the effects in `exact`."""
        asking = [entry for name, entry in self.effects.items() if name not in exact]
        formats = [item for effect, knobs in asking for item in effect.stores(knobs).items()]
        return {channel: name for channel, name in formats if name != "fp32"}

    def is_storage(self, player: str) -> bool:
        """Whether a player is an effect that only stores the G-buffer's channels otherwise."""
        return player in self.effects and bool(self.effects[player][0].stores(self.effects[player][1]))

    def with_true_surface(self) -> "Plan":
        """The same frame of the true surface, without what the effect that draws another one would draw."""
        others = {name for name, (effect, _) in self.effects.items() if effect.surface is not None}
        steps = tuple(step for step in self.steps if step.effect not in others)
        return replace(self, scene=self.true_scene, steps=steps)

    def effect_of(self, term: str) -> str | None:
        """The name of the effect that gives a term of the frame; None where none does."""
        return next(iter(self.effects_of(term)), None)

    def effects_of(self, term: str) -> tuple[str, ...]:
        """The names of all effects that have a part in a term."""
        return tuple(name for name in self.effects if term in self.terms_of(name))

    @property
    def sampler(self) -> str | None:
        """The effect that chooses where in the pixel the scene is sampled; None where none does."""
        return next((name for name in self.effects_of("coverage") if not self.filters_display(name)), None)

    def filters_display(self, effect: str) -> bool:
        """Whether an effect filters code values: no player of the scene-linear image."""
        return effect in self.effects and self.effects[effect][0].stage == "display"

    def terms_of(self, effect: str) -> tuple[str, ...]:
        """What an effect gives of this frame: another may be preferred for some of the terms that it declares."""
        declared = self.effects[effect][0].terms
        drawn = {term for step in self.steps if step.effect == effect for term in step.writes}
        return tuple(t for t in declared if t in drawn or (t not in DRAWN_TERMS and t not in self.missing))

    @property
    def reads_scattered(self) -> bool:
        """Whether any effect reads the lit frame so far."""
        return any("scattered" in step.reads for step in self.steps)

    def why_absent(self, effect: str) -> str:
        """Why an effect that exists takes no part in this frame."""
        return next((item.why for item in self.left_out if item.what == effect), "nothing in this frame needs it")

    def lights_of(self, effect: str) -> tuple[int, ...]:
        """The lights an effect is drawn for."""
        return tuple(step.light for step in self.steps if step.effect == effect and step.light is not None)


def compile_plan(scene: Scene, known: Mapping[str, Effect], choice: Choice | None = None) -> Plan:
    """Choose the effects that `scene` needs and order what they draw.

    Raises:
        EffectError: where the choice names an effect or a knob that does not exist, or a value out of range.
    """
    choice = choice or Choice()
    _check_names(choice, known)
    settings = {name: effect.settings(choice.settings.get(name, {})) for name, effect in known.items()}
    missing = _missing(scene, known, choice)
    candidates, left_out = _candidates(scene, known, choice, missing)

    steps, uncovered = _steps(scene, candidates, missing, choice)
    taken = {step.effect for step in steps}
    for term in (t for t in TERMS if TERMS[t].scope == "gbuffer" and t not in missing):
        variants = _of_gbuffer(candidates, term, choice)
        taken |= variants
        uncovered += [] if variants else [term]
    idle = [e for e in candidates if e.name not in taken and e.name not in choice.without]
    left_out += [_superseded(scene, effect, steps, candidates, choice) for effect in idle]
    left_out += [LeftOut(f"term {term}", why) for term, why in missing.items()]
    used = {name: (known[name], settings[name]) for name in known if name in taken}
    channels = frozenset(channel for effect, _ in used.values() for channel in effect.channels)
    drawn, true = _surfaces(scene, used)
    return Plan(drawn, tuple(steps), channels, used, tuple(left_out), tuple(uncovered), true, missing)


def _missing(scene: Scene, known: Mapping[str, Effect], choice: Choice) -> dict[str, str]:
    """The terms that the frame lacks: the scene's, but for those in which an effect is asked to vary the G-buffer."""
    missing = missing_terms(scene)
    for effect in (known[name] for name in known if _is_asked(name, choice) and name not in choice.without):
        for term in effect.terms:
            if TERMS[term].scope == "gbuffer" and not effect.unneeded(scene):
                missing.pop(term, None)
    return missing


def _is_asked(name: str, choice: Choice) -> bool:
    return name in choice.use or name in choice.only


def _of_gbuffer(candidates: list[Effect], term: str, choice: Choice) -> set[str]:
    """The effects that vary the G-buffer in a term: the first candidate for each part of it."""
    candidates = [effect for effect in candidates if effect.stage != "display"]
    parts = dict.fromkeys(effect.part for effect in candidates if term in effect.terms)
    found = (_first(candidates, term, choice, lambda e, part=part: e.part == part) for part in parts)
    return {effect.name for effect in found if effect is not None}


def _surfaces(scene: Scene, used: Mapping[str, tuple[Effect, Knobs]]) -> tuple[Scene, Scene]:
    """The scene as it is drawn, and with its true surface: both as given, unless an effect draws another."""
    for effect, knobs in used.values():
        if effect.surface is not None:
            return effect.surface(scene, knobs), true_surface(scene)
    return scene, scene


def _check_names(choice: Choice, known: Mapping[str, Effect]) -> None:
    for name in (*choice.only, *choice.without, *choice.use, *choice.settings):
        if name not in known:
            raise EffectError(f"there is no effect {name!r}; {nearest(name, list(known))}")


def _candidates(scene: Scene, known: Mapping[str, Effect], choice: Choice, missing: Mapping[str, str]):
    """The effects this scene needs, the preferred ones first; and those that take no part, with reasons.

    What the user leaves out is among both: it still holds the place of what would be taken by default.
    """
    kept, left_out = [], []
    for name, effect in known.items():
        if choice.only and name not in choice.only:
            left_out.append(LeftOut(name, "not among the effects asked for"))
            continue
        needless = _why_needless(scene, effect, choice, missing)
        if name in choice.without or needless:
            left_out.append(LeftOut(name, "left out as asked" if name in choice.without else needless))
        if not needless:
            kept.append(effect)
    kept.sort(key=lambda e: (e.name not in choice.use, e.rank, e.name))
    return kept, left_out


def _why_needless(scene: Scene, effect: Effect, choice: Choice, missing: Mapping[str, str]) -> str:
    """Why a frame does not need an effect; "" where it does. A true surface is missed only where one is asked for."""
    others = [term for term in effect.terms if term != "surface"]
    if others and all(term in missing for term in others):
        return missing[others[0]]
    if reason := effect.unneeded(scene):
        return reason
    if effect.optional and not _is_asked(effect.name, choice):
        return f"takes part where it is asked for: --use {effect.name}"
    return ""


def _first(
    candidates: list[Effect], term: str, choice: Choice, fits: Callable[[Effect], bool] = lambda _effect: True
) -> Effect | None:
    """The effect that gives a term: the first candidate; none where that one was left out."""
    found = next((effect for effect in candidates if term in effect.terms and fits(effect)), None)
    return None if found is None or found.name in choice.without else found


def _steps(
    scene: Scene, candidates: list[Effect], missing: Mapping[str, str], choice: Choice
) -> tuple[list[Step], list[str]]:
    """The steps in order: light by light, then what belongs to the frame, then the display; and terms without one."""
    steps: list[Step] = []
    uncovered: dict[str, None] = {}

    def first(term: str, light: int | None = None) -> Effect | None:
        if term in missing:
            return None
        found = _first(candidates, term, choice, lambda e: light is None or e.lights(scene, scene.all_lights[light]))
        if found is None:
            uncovered.setdefault(term)
        return found

    for light in range(len(scene.all_lights)):
        visibility, direct = first("visibility", light), first("direct", light)
        if direct is None:
            continue  # a visibility that nothing multiplies is not drawn
        if visibility:
            steps.append(Step(visibility.name, ("visibility",), (), light))
        steps.append(Step(direct.name, ("direct",), ("visibility",) if visibility else (), light))

    environment, indirect = first("environment"), first("indirect")
    visibility = first("environment_visibility")
    if visibility and environment:
        steps.append(Step(visibility.name, ("environment_visibility",)))
    factor = ("environment_visibility",) if visibility and environment else ()
    if environment and environment is indirect:
        steps.append(Step(environment.name, ("environment", "indirect"), factor))
    else:
        if environment:
            steps.append(Step(environment.name, ("environment",), factor))
        if indirect:
            steps.append(Step(indirect.name, ("indirect",), ("scattered",) if indirect.reads_scattered else ()))
    if transmission := first("transmission"):
        steps.append(Step(transmission.name, ("transmission",)))
    image = "radiance"
    for term in DISPLAY_TERMS:
        for effect in _of_display(candidates, term, choice) if first(term) else ():
            steps.append(Step(effect.name, (term,), (image,)))
            image = term
    if image == "encode":
        filters = [effect for effect in candidates if effect.stage == "display"]
        steps += [Step(effect.name, ("coverage",), (image,)) for effect in _of_display(filters, "coverage", choice)]
    return steps, list(uncovered)


def _of_display(candidates: list[Effect], term: str, choice: Choice) -> list[Effect]:
    """What is drawn of a display term: the first candidate for each part of it, what has no part of its own first."""
    parts = sorted({effect.part for effect in candidates if term in effect.terms})
    found = (_first(candidates, term, choice, lambda e, part=part: e.part == part) for part in parts)
    return [effect for effect in found if effect is not None]


def _in_one_place(one: Effect, other: Effect) -> bool:
    """Whether a frame takes one of two effects at most: both vary the same part, or both choose the samples."""
    if one.part != other.part:
        return False
    both = set(one.terms) & set(other.terms)
    return bool(one.part) or ("coverage" in both and "display" not in (one.stage, other.stage))


def _superseded(scene: Scene, effect: Effect, steps: list[Step], candidates: list[Effect], choice: Choice) -> LeftOut:
    """Why a candidate was not taken."""
    lit = any(effect.lights(scene, light) for light in scene.all_lights)
    if not lit and any(TERMS[term].scope == "light" for term in effect.terms):
        return LeftOut(effect.name, "the scene has no light of the kinds it handles")
    if effect.stage == "display" and not any(step.writes == ("encode",) for step in steps):
        return LeftOut(effect.name, "it filters code values, and nothing in this frame encodes")
    others = sorted({s.effect for s in steps if set(s.writes) & set(effect.terms)})
    others += [e.name for e in candidates if _in_one_place(e, effect) and e.name not in choice.without][:1]
    if others:
        given = {term for step in steps for term in step.writes}
        terms = [term for term in effect.terms if term in given or term not in DRAWN_TERMS]
        return LeftOut(effect.name, f"{', '.join(others)} gives {', '.join(terms)} already")
    out = [e.name for e in candidates if e.name in choice.without and set(e.terms) & set(effect.terms)]
    if out:
        return LeftOut(effect.name, f"takes the place of {', '.join(out)} where it is asked for: --use {effect.name}")
    return LeftOut(effect.name, f"nothing in this frame reads {', '.join(effect.terms)}")
