"""Finds the effects: every folder of `effects/` whose package declares `EFFECT`."""

from dataclasses import replace
from functools import cache
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules

from . import effects as package
from .effect import Effect, EffectError, nearest


@cache
def effects() -> dict[str, Effect]:
    """Every effect by its name, in order of term, rank and name."""
    found = []
    for path in package.__path__:
        for info in iter_modules([path]):
            if info.ispkg:
                declared = import_module(f"{package.__name__}.{info.name}").EFFECT
                found.append(replace(declared, folder=Path(path) / info.name))
    return {effect.name: effect for effect in sorted(found, key=lambda e: (e.terms, e.rank, e.name))}


def effect(name: str) -> Effect:
    """The effect of that name.

    Raises:
        EffectError: where there is none; names the nearest.
    """
    known = effects()
    if name not in known:
        raise EffectError(f"there is no effect {name!r}; {nearest(name, list(known))}")
    return known[name]
