"""Hints for misspelt words."""

from collections.abc import Iterable


def nearest(word: str, known: Iterable[str]) -> str:
    """A hint for a word that is not known: "did you mean 'x'?", else the known ones."""
    from difflib import get_close_matches

    names = sorted(known)
    close = get_close_matches(word[:200], names, n=1, cutoff=0.5)
    return f"did you mean {close[0]!r}?" if close else f"there are: {', '.join(names[:40]) or 'none'}"
