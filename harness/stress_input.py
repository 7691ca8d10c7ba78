"""An input of a GLSL function, from the words of the command line."""

from collections.abc import Sequence

import numpy as np

from lightmeter.failures import UsageError
from lightmeter.hints import nearest
from lightmeter.realtime.twin import Argument


def parse(words: Sequence[str], arguments: Sequence[Argument]) -> list[np.ndarray]:
    """One lane, (components, 1) per argument, as float32 holds it.

    Args:
        words: "ARGUMENT=X" or "ARGUMENT=X,Y,Z", each argument once.

    Raises:
        UsageError: an argument is unknown, lacks, is given twice, or has another number of components.
    """
    given: dict[str, np.ndarray] = {}
    sizes = {argument.name: argument.size for argument in arguments}
    for word in words:
        name, equals, text = word.partition("=")
        if not equals or name not in sizes:
            raise UsageError(f"--input: expected ARGUMENT=X,Y…, got {word!r}; {nearest(name, sizes)}")
        if name in given:
            raise UsageError(f"--input: {name!r} is given twice")
        given[name] = _components(name, text, sizes[name])
    lacking = [name for name in sizes if name not in given]
    if lacking:
        raise UsageError(f"--input: the function takes {', '.join(sizes)}; there is no {', '.join(lacking)}")
    return [given[name] for name in sizes]


def _components(name: str, text: str, size: int) -> np.ndarray:
    try:
        values = np.array([float(part) for part in text.split(",")])
    except ValueError:
        values = np.array([np.nan])
    with np.errstate(over="ignore"):
        held = values.astype(np.float32).astype(np.float64)
    if len(held) != size or not np.isfinite(held).all():
        what = "a number" if size == 1 else f"{size} numbers parted by commas"
        raise UsageError(f"--input: {name!r} is {what} that float32 can hold, got {text!r}")
    return held[:, None]
