"""What all pages are made with: their assets, templates that escape, and what may stand inside a script element.

A page is one file that opens from disk without network. Its content security policy forbids every request, and every
script but the page's own (by hash), so that nothing in a scene's name or a driver's string can run or call home.
"""

from __future__ import annotations

import base64
import hashlib
import json
from importlib import resources
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import jinja2


def asset(name: str) -> str:
    """The text of a file in `reports/page/`."""
    return resources.files("lightmeter.reports.page").joinpath(name).read_text(encoding="utf-8")


def template(name: str) -> jinja2.Template:
    """A template in `reports/page/`; it escapes what it is given, and a name that it lacks is an error."""
    import jinja2

    environment = jinja2.Environment(
        loader=jinja2.FunctionLoader(asset),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    return environment.get_template(name)


def script_hash(script: str) -> str:
    """The base64 of a script's SHA-256, by which a content security policy lets it run."""
    return base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()


def script_safe(value: Any) -> str:
    """JSON that can stand inside a script element: no character that could end it."""
    text = json.dumps(value, ensure_ascii=True, allow_nan=False)
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def device_rows(device: dict[str, Any]) -> list[tuple[str, Any]]:
    """The machine's facts as a page lists them; what is not known is a dash."""
    return [(key.replace("_", " "), "—" if value is None else value) for key, value in device.items()]
