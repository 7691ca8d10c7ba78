"""A sweep as one HTML file that opens from disk without network, with its numbers beside it as JSON and CSV.

plotly.js is inside the file. As with the report, a content security policy forbids every request, and every script
but the page's own (by hash).
"""

import base64
import hashlib
import json
import os
from importlib import resources
from pathlib import Path
from typing import Any

from lightmeter.reports.metric_words import definition, label
from lightmeter.reports.results_json import to_json
from lightmeter.reports.significant import show_interval, show_value
from lightmeter.reports.sweep_figures import figures
from lightmeter.reports.sweep_results import METRICS, VIEWS, Setting, Sweep, SweptEffect, to_csv
from lightmeter.reports.sweep_table import conclusions, crossing, remarks, show_bake, show_time
from lightmeter.reports.truth_words import truth_words


def write_sweep(folder: str | os.PathLike[str], sweep: Sweep) -> Path:
    """Write `sweep.html`, `sweep.json` and `sweep.csv` into `folder`, each in one step; gives the page's path."""
    target = Path(folder)
    target.mkdir(parents=True, exist_ok=True)
    texts = {"sweep.json": to_json(sweep), "sweep.csv": to_csv(sweep), "sweep.html": render_sweep(sweep)}
    for name, text in texts.items():
        partial = target / f".{name}.{os.getpid()}.part"
        partial.write_text(text, encoding="utf-8")
        partial.replace(target / name)
    return target / "sweep.html"


def render_sweep(sweep: Sweep) -> str:
    """The page's text."""
    import jinja2
    from plotly.offline import get_plotlyjs

    environment = jinja2.Environment(
        autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    scripts = [get_plotlyjs(), _asset("sweep.js")]
    plots = [figures(swept, sweep.path_tracer, METRICS, sweep.others) for swept in sweep.effects]
    return environment.from_string(_asset("sweep.html")).render(
        scene=sweep.scene,
        subtitle=_subtitle(sweep),
        complete=sweep.complete,
        views=VIEWS,
        metrics=[{"name": name, "label": label(name), "definition": definition(name)} for name in METRICS],
        effects=[_section(swept) for swept in sweep.effects],
        notes=sweep.notes,
        device=[(key.replace("_", " "), "—" if value is None else value) for key, value in sweep.device.items()],
        style=_asset("report.css") + _asset("sweep.css"),
        scripts=scripts,
        hashes=[base64.b64encode(hashlib.sha256(script.encode()).digest()).decode() for script in scripts],
        plots=_script_safe(plots),
    )


def _subtitle(sweep: Sweep) -> str:
    width, height = sweep.size
    return (
        f"Error against run time · {width} × {height} pixels · reference of {sweep.reference.spp} samples per pixel in "
        f"{sweep.reference.batches} batches{truth_words(sweep.reference)}"
    )


def _section(swept: SweptEffect) -> dict[str, Any]:
    tables = [_table(swept, view, metric) for view in VIEWS for metric in METRICS]
    terms = ", ".join(swept.terms)
    return {"name": swept.effect, "terms": terms, "tables": tables, "bakes": swept.bakes, "remarks": remarks(swept)}


def _table(swept: SweptEffect, view: str, metric: str) -> dict[str, Any]:
    if view in swept.views:
        rows = [_row(setting, view, metric) for setting in swept.settings]
        sentences = [s for s in conclusions(swept, view) if s.startswith(f"Least {label(metric)}")]
    else:
        rows, sentences = [], [f"{swept.effect} changes code values, and no light of the frame."]
    return {"view": view, "metric": metric, "rows": rows, "sentences": sentences}


def _row(setting: Setting, view: str, metric: str) -> dict[str, Any]:
    standing = setting.standing(view)
    measured = standing.metrics[metric]
    return {
        "label": setting.label,
        "current": setting.current,
        "value": show_value(measured),
        "interval": show_interval(measured),
        "unit": measured.unit,
        "how": measured.how,
        "time": show_time(standing.time_ms),
        "bake": show_bake(setting),
        "front": standing.front.get(metric, False),
        "crossing": crossing(standing, metric),
    }


def _asset(name: str) -> str:
    return resources.files("lightmeter.reports.page").joinpath(name).read_text(encoding="utf-8")


def _script_safe(value: Any) -> str:
    """JSON that can stand inside a script element: no character that could end it."""
    text = json.dumps(value, ensure_ascii=True, allow_nan=False)
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")
