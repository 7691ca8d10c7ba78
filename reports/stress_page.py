"""A stress run as one HTML file that opens from disk without network, with its numbers beside it as JSON."""

from pathlib import Path
from typing import Any

from lightmeter.realtime.stress.findings import FORMATS, Cell, Stressed
from lightmeter.realtime.stress.regimes import REGIMES
from lightmeter.reports.one_step import write_text
from lightmeter.reports.page_file import asset, device_rows, script_hash, script_safe, template
from lightmeter.reports.results_json import to_json
from lightmeter.reports.stress_laws import MEANING, rows, violations
from lightmeter.reports.stress_results import StressResults, command, inherent, shown
from lightmeter.reports.stress_table import safe_domain


def write_stress(folder: Path, results: StressResults) -> Path:
    """Write `stress.html` and `stress.json` into `folder`, each in one step; gives the page's path."""
    write_text(folder / "stress.json", to_json(results))
    return write_text(folder / "stress.html", render_stress(results))


def render_stress(results: StressResults) -> str:
    """The page's text."""
    script = asset("stress.js")
    return template("stress.html").render(
        formats=FORMATS,
        style=asset("report.css") + asset("stress.css"),
        script=script,
        hash=script_hash(script),
        device=device_rows(results.device),
        count=len(results.functions),
        seed=results.seed,
        data=script_safe(_model(results)),
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
