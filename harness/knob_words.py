"""Which settings of an effect a sweep visits, from what the command line says."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from math import prod

from lightmeter.failures import UsageError
from lightmeter.realtime.effect import Effect, Knobs, KnobValue

MOST_SETTINGS = 256
"""Of a grid. A setting takes seconds; all values of all knobs of one effect would be thousands of settings."""


@dataclass(frozen=True)
class Visit:
    """One setting to measure.

    Attributes:
        knobs: every knob's value.
        varied: the knobs that set it apart, see `reports.sweep_results.Setting`.
    """

    knobs: Knobs
    varied: tuple[str, ...]


def visits(effect: Effect, current: Knobs, words: Sequence[str] = (), grid: bool = True) -> list[Visit]:
    """The settings to measure, each once.

    Args:
        current: every knob's value where nothing is varied.
        words: "NAME" or "NAME=v1,v2,…"; none at all: every knob that declares values for a sweep, one at a time.
        grid: whether several that are named give their full grid; else these too are varied one at a time.

    Raises:
        UsageError: a knob is named twice or has no values, there is nothing to vary, or the grid is too large.
        EffectError: the effect has no such knob, or the knob takes no such value.
    """
    values = asked(effect, words) if words else declared(effect)
    if not values:
        raise UsageError(f"{effect.name} has no knob that declares values for a sweep{_others(effect)}")
    return _grid(values, current) if words and grid else _star(values, current)


def declared(effect: Effect) -> dict[str, tuple[KnobValue, ...]]:
    """The knobs that declare values for a sweep."""
    return {k.name: tuple(k.read(v, effect.name) for v in k.sweep) for k in effect.knobs if k.sweep}


def asked(effect: Effect, words: Sequence[str]) -> dict[str, tuple[KnobValue, ...]]:
    """The knobs and values that the words name; raises as `visits` does."""
    found: dict[str, tuple[KnobValue, ...]] = {}
    for word in words:
        name, given, text = (part.strip() for part in word.partition("="))
        if name in found:
            raise UsageError(f"--knob {name} is given twice; put all its values into one: --knob {name}=v1,v2")
        knob = effect.knob(name)
        if given:
            found[name] = tuple(knob.read(value.strip(), effect.name) for value in text.split(","))
        elif knob.sweep:
            found[name] = declared(effect)[name]
        else:
            raise UsageError(f"{effect.name}.{name} declares no values for a sweep; give them: --knob {name}=v1,v2")
    return found


def _star(values: Mapping[str, Sequence[KnobValue]], current: Knobs) -> list[Visit]:
    """The current setting, and from there one knob at a time."""
    found = [Visit(dict(current), ())]
    for name, settings in values.items():
        found += [Visit({**current, name: value}, (name,)) for value in settings]
    return _once(found)


def _grid(values: Mapping[str, Sequence[KnobValue]], current: Knobs) -> list[Visit]:
    """Every combination."""
    names = tuple(values)
    sides = [len(set(listed)) for listed in values.values()]
    if prod(sides) > MOST_SETTINGS:
        raise UsageError(
            f"--knob: a grid of {' × '.join(map(str, sides))} = {prod(sides)} settings; expected at most "
            f"{MOST_SETTINGS}: give fewer values (--knob NAME=v1,v2), or --one-at-a-time"
        )
    combinations = [dict(zip(names, chosen, strict=True)) for chosen in product(*values.values())]
    return _once([Visit({**current, **combination}, names) for combination in combinations])


def _once(found: list[Visit]) -> list[Visit]:
    """Each setting where it comes first."""
    unique: dict[tuple, Visit] = {}
    for visit in found:
        unique.setdefault(tuple(visit.knobs.items()), visit)
    return list(unique.values())


def _others(effect: Effect) -> str:
    names = ", ".join(knob.name for knob in effect.knobs)
    return f"; give a knob's own: --knob NAME=v1,v2 (it has {names})" if names else "; it has no knobs at all"
