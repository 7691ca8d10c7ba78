"""Names and messages as they can be shown: in one line, not too long, unable to steer a terminal.

They come from users, scene files and other people's programs. That they cannot become markup is up to where they are
shown.
"""

import unicodedata


def printable(text: str) -> str:
    """`text` in one line; in place of each letter that is not printable (Unicode categories Other and Separator but
    the space, so also what turns the direction of a line) the replacement character."""
    return "".join(letter if letter.isprintable() else "\N{REPLACEMENT CHARACTER}" for letter in text)


def printable_lines(text: str) -> str:
    """The same line by line, without empty ones at the ends."""
    return "\n".join(printable(line.expandtabs(4)).rstrip() for line in text.strip().splitlines())


def short_name(name: str, longest: int = 32) -> str:
    """`name` in one line, at most `longest` columns wide; cut in its middle, since versions stand at the end."""
    shown = printable(name)
    if text_width(shown) <= longest:
        return shown
    tail = _fitting(shown[::-1], (longest - 1) // 2)[::-1]
    head = _fitting(shown, longest - 1 - text_width(tail))
    return f"{head}…{tail}"


def _fitting(text: str, columns: int) -> str:
    """As much of the beginning as is at most `columns` wide."""
    used = 0
    for index, letter in enumerate(text):
        used += text_width(letter)
        if used > columns:
            return text[:index]
    return text


def text_width(text: str) -> int:
    """How many columns `text` takes: a wide letter takes two (Unicode Standard Annex 11)."""
    return sum(2 if unicodedata.east_asian_width(letter) in "WF" else 1 for letter in text)
