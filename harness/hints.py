"""Hints for misspelt words."""

from collections.abc import Iterable


def nearest(word: str, known: Iterable[str]) -> str:
    """A hint for a word that is not known: "did you mean 'x'?", else the known ones."""
    from lightmeter.scenes.errors import closest, listed

    names = sorted(known)
    close = closest(word, names)
    return f"did you mean {close!r}?" if close else f"there are: {listed(names) or 'none'}"
