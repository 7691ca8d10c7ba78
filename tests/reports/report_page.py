"""A report in the browser, ready to be looked at."""

from pathlib import Path

import pytest

from .chromium_pipe import Page, find_chromium

needs_chromium = pytest.mark.skipif(find_chromium() is None, reason="no chromium on this machine")
SHOWN = "document.querySelector('#viewer').dataset.shown === '{}'"


def open_report(page: Page, path: Path, first: str = "frame", fragment: str = "") -> None:
    page.send("Page.navigate", url="about:blank")
    page.until("location.href === 'about:blank'")
    page.open(path, fragment)
    page.until(f"document.querySelector('#viewer') && {SHOWN.format(first)}")


def click(page: Page, selector: str) -> None:
    """A real click in the middle of what the selector finds."""
    place = page.evaluate(
        f"(e => {{ e.scrollIntoView({{block: 'center'}}); const b = e.getBoundingClientRect();"
        f"return [b.left + b.width / 2, b.top + b.height / 2]; }})(document.querySelector({selector!r}))"
    )
    page.mouse("mousePressed", *place, button="left", clickCount=1)
    page.mouse("mouseReleased", *place, button="left", clickCount=1)
