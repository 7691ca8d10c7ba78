"""A sweep as one HTML file that opens from disk without network, with its numbers beside it as JSON and CSV.

plotly.js is inside the file.
"""

import os
from pathlib import Path
from typing import Any

from lightmeter.reports.metric_words import definition, label
from lightmeter.reports.one_step import write_text
from lightmeter.reports.page_file import asset, device_rows, script_hash, script_safe, template
from lightmeter.reports.results_json import to_json
from lightmeter.reports.significant import show_interval, show_value
from lightmeter.reports.sweep_figures import figures
from lightmeter.reports.sweep_results import METRICS, VIEWS, Setting, Sweep, SweptEffect, to_csv
from lightmeter.reports.sweep_table import conclusions, crossing, remarks, show_bake, show_time
from lightmeter.reports.truth_words import truth_words


def write_sweep(folder: str | os.PathLike[str], sweep: Sweep) -> Path:
    """Write `sweep.html`, `sweep.json` and `sweep.csv` into `folder`, each in one step; gives the page's path."""
    target = Path(folder)
    write_text(target / "sweep.json", to_json(sweep))
    write_text(target / "sweep.csv", to_csv(sweep))
    return write_text(target / "sweep.html", render_sweep(sweep))


def render_sweep(sweep: Sweep) -> str:
    """The page's text."""
    from plotly.offline import get_plotlyjs

    scripts = [get_plotlyjs(), asset("sweep.js")]
    plots = [figures(swept, sweep.path_tracer, METRICS, sweep.others) for swept in sweep.effects]
    return template("sweep.html").render(
        scene=sweep.scene,
        subtitle=_subtitle(sweep),
        complete=sweep.complete,
        views=VIEWS,
        metrics=[{"name": name, "label": label(name), "definition": definition(name)} for name in METRICS],
        effects=[_section(swept) for swept in sweep.effects],
        notes=sweep.notes,
        device=device_rows(sweep.device),
        style=asset("report.css") + asset("sweep.css"),
        scripts=scripts,
        hashes=[script_hash(script) for script in scripts],
        plots=script_safe(plots),
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
