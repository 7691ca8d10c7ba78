"""The one error that reading and writing images raises."""

import os

_LONGEST = 200
"""Characters of what was expected or found, which may be a damaged file's own bytes."""


class ImageError(ValueError):
    """An image that cannot be read: what is wrong, where, what was expected, what was found, how to mend it."""

    def __init__(
        self,
        what: str,
        *,
        where: str | os.PathLike[str],
        expected: str = "",
        actual: str = "",
        remedy: str = "",
    ) -> None:
        self.what = what
        self.where = os.fspath(where)
        self.expected = expected
        self.actual = actual
        self.remedy = remedy
        facts = [f"expected {_one_line(expected)}" if expected else "", f"found {_one_line(actual)}" if actual else ""]
        message = f"{self.where}: {what}"
        if any(facts):
            message += ": " + ", ".join(fact for fact in facts if fact)
        super().__init__(message + (f". {remedy}" if remedy else ""))


def _one_line(text: str) -> str:
    """`text` as it can be printed: no control characters, and cut where it is too long."""
    printable = "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in text)
    return printable if len(printable) <= _LONGEST else printable[: _LONGEST - 1] + "…"
