"""A stress run as one HTML file that opens from disk without network, with its numbers beside it as JSON.

As with the other pages, a content security policy forbids every request, and every script but the page's own.
"""

import base64
import hashlib
import json
import os
from importlib import resources
from pathlib import Path
from typing import Any

from lightmeter.realtime.stress.findings import FORMATS, Cell, Stressed
from lightmeter.realtime.stress.regimes import REGIMES
from lightmeter.reports.results_json import to_json
from lightmeter.reports.stress_laws import MEANING, rows, violations
from lightmeter.reports.stress_results import StressResults, command, inherent, shown
from lightmeter.reports.stress_table import safe_domain


def write_stress(folder: Path, results: StressResults) -> Path:
    """Write `stress.html` and `stress.json` into `folder`, each in one step; gives the page's path."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in {"stress.json": to_json(results), "stress.html": render_stress(results)}.items():
        partial = folder / f".{name}.{os.getpid()}.part"
        partial.write_text(text, encoding="utf-8")
        partial.replace(folder / name)
    return folder / "stress.html"


def render_stress(results: StressResults) -> str:
    """The page's text."""
    import jinja2

    environment = jinja2.Environment(
        autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    script = _asset("stress.js")
    return environment.from_string(_asset("stress.html")).render(
        formats=FORMATS,
        style=_asset("report.css") + _asset("stress.css"),
        script=script,
        hash=base64.b64encode(hashlib.sha256(script.encode()).digest()).decode(),
        device=[(key.replace("_", " "), "—" if value is None else value) for key, value in results.device.items()],
        count=len(results.functions),
        seed=results.seed,
        data=_script_safe(_model(results)),
        laws=_laws(results),
        laws_meaning=MEANING,
    )


def _model(results: StressResults) -> dict[str, Any]:
    regimes = [r for r in REGIMES if any(r in f.cells["fp32"] for f in results.functions)]
    return {
        "regimes": [{"name": r, "meaning": REGIMES[r]} for r in regimes],
        "functions": [_function(f, regimes) for f in results.functions],
    }


def _laws(results: StressResults) -> list[dict[str, Any]]:
    return [
        {
            "cells": cells,
            "one_sided": held.one_sided in ("model", "device"),
            "gains": bool(held.gains),
            "violations": violations(name, held),
        }
        for cells, (name, held) in zip(rows(results.laws), results.laws.items(), strict=True)
    ]


def _function(function: Stressed, regimes: list[str]) -> dict[str, Any]:
    cells = {
        form: [_cell(function.name, found[r]) if r in found else None for r in regimes]
        for form, found in function.cells.items()
    }
    return {"name": function.name, "file": function.file, "safe": safe_domain(function), "cells": cells}


def _cell(name: str, cell: Cell) -> dict[str, Any]:
    example = cell.example
    counts = ", ".join(f"{fault}: {n}" for fault, n in cell.counts.items() if n)
    model: dict[str, Any] = {"text": shown(cell), "digits": round(cell.digits, 2), "fault": cell.fault}
    model |= {"inherent": inherent(cell), "lanes": cell.lanes, "counts": counts}
    if example:
        model |= {
            "command": command(name, example),
            "got": _numbers(example.got),
            "exact": _numbers(example.exact),
            "relative": f"{example.relative:.3g}",
            "absolute": f"{example.absolute:.3g}",
            "attainable": round(example.attainable, 1),
        }
    return model


def _numbers(values: list[float]) -> str:
    return ", ".join(f"{v:.9g}" for v in values)


def _asset(name: str) -> str:
    return resources.files("lightmeter.reports.page").joinpath(name).read_text(encoding="utf-8")


def _script_safe(value: Any) -> str:
    """JSON that can stand inside a script element: no character that could end it."""
    text = json.dumps(value, ensure_ascii=True, allow_nan=False)
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")
