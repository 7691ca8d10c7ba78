"""Where results are printed."""

from rich.console import Console

LOG_WIDTH = 120
"""Columns where stdout is no terminal: a log has no width of its own, and tables that wrap are hard to search."""


def console() -> Console:
    """Standard output."""
    out = Console()
    return out if out.is_terminal else Console(width=LOG_WIDTH)
