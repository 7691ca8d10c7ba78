"""The oracles: one file per term, named after it, found by name.

Each module has `TERM`, a docstring with the term's exact meaning, and `evaluate`:

- per frame:      evaluate(world, points, *, spp, seed, batch) -> (H, W, 3), or (2, H, W, 3): A and B
- per light:      evaluate(world, points, light, *, spp, seed, batch) -> likewise
- `material`:     evaluate(world, points) -> SurfacePoints
- `coverage`:     evaluate(batches, samples, *, seed) -> (K, n, 2) sub-pixel offsets
- display terms:  evaluate(image) -> image

Arrays are float32. One call is one batch; batches of one seed are independent of each other.
"""

from importlib import import_module
from pkgutil import iter_modules
from types import ModuleType


def names() -> list[str]:
    """The terms that have an oracle, in order."""
    return sorted(module.name for module in iter_modules(__path__) if not module.name.startswith("_"))


def find(term: str) -> ModuleType:
    """The oracle of a term; importing it may import Mitsuba.

    Raises:
        LookupError: no file is named so.
    """
    if term not in names():
        raise LookupError(f"no oracle for the term {term!r}; there are {', '.join(names())}")
    return import_module(f"{__name__}.{term}")
