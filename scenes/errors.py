"""What is said when a scene cannot be read: what, where, expected against actual, and how to mend it."""

from collections.abc import Iterable
from difflib import get_close_matches


class SceneError(ValueError):
    """A scene's source is wrong or out of reach.

    Attributes:
        what: the fault, one clause.
        where: file, and the place in it (a dotted key, a line, a byte).
        expected, actual: what would have been right, and what was found.
        remedy: what to do about it.
    """

    def __init__(self, what: str, *, where: str = "", expected: str = "", actual: str = "", remedy: str = ""):
        self.what, self.where, self.expected, self.actual, self.remedy = what, where, expected, actual, remedy
        super().__init__(str(self))

    def __str__(self) -> str:
        text = f"{self.where}: {self.what}" if self.where else self.what
        comparison = [f"{word} {value}" for word, value in (("expected", self.expected), ("got", self.actual)) if value]
        if comparison:
            text += ": " + ", ".join(comparison)
        if self.remedy:
            text += ". " + self.remedy[:1].upper() + self.remedy[1:]
        return text

    def within(self, place: str) -> "SceneError":
        """The same fault, seen from outside: `place` is put before `where`."""
        where = f"{place}: {self.where}" if self.where else place
        return SceneError(self.what, where=where, expected=self.expected, actual=self.actual, remedy=self.remedy)


def shown(value: object, limit: int = 60) -> str:
    """`value` as it is written in a message: one line, cut at `limit` characters."""
    try:
        text = repr(value)
    except (ValueError, RecursionError):  # an integer of thousands of digits; a cycle
        return f"a {type(value).__name__} too large to print"
    return text if len(text) <= limit else text[: limit - 1] + "…"


def closest(name: str, names: Iterable[str]) -> str | None:
    """The one of `names` that `name` is short for, else the one that it is most likely a misspelling of."""
    name, names = name[:200], sorted(names)
    longer = [one for one in names if len(name) > 2 and one.startswith(name)]
    return min(longer, key=len) if longer else next(iter(get_close_matches(name, names, n=1)), None)


def listed(names: Iterable[str], limit: int = 30) -> str:
    """`names` in their order; of more than `limit` the first, and how many others there are."""
    names = sorted(names)
    rest = f" and {len(names) - limit} more" if len(names) > limit else ""
    return ", ".join(names[:limit]) + rest


def nearest(name: str, valid: Iterable[str]) -> str:
    """A remedy that names the closest of the `valid` names, or lists them when none is close."""
    names = sorted(valid)
    if close := closest(name, names):
        return f"did you mean {close!r}?"
    return f"valid: {listed(names)}" if names else ""
