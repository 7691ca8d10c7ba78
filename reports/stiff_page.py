"""Stiff scenes as one HTML file that opens from disk without network, with its numbers beside it as JSON.

A card a scene: both sides through the same display transform, the error between them in one scale for all, what each
side said, and the command lines that render it again. There is no script, and a content security policy forbids any.
"""

import os
from collections.abc import Mapping
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.engine_strip import NOT_FINITE, reduced
from lightmeter.reports.heatmap import colour_map, colourise
from lightmeter.reports.results_json import to_json
from lightmeter.reports.significant import show_measurement, show_number
from lightmeter.reports.stiff_results import SAME, Finding, StiffPictures, StiffResults, blamed, doubt, state
from lightmeter.reports.thumbnails import png_uri

COLOURS = "magma"
SIDE = 256
"""Pixels of a picture's longer side at most; a longer one is averaged down."""
STATES = {
    "finite": ("✓", "both sides are finite"),
    "refused": ("⊘", "refused with the fault, before either side has it"),
    "not finite": ("✕", "pixels of a side are NaN or infinite"),
}
DOUBTS = {
    "not trusted": ("?", "the reference fails its own checks: nothing is decided on it"),
    "not converged": ("≈", "the reference's noise is above a tenth of its mean"),
    "black": ("●", "the reference is black: there is nothing that an error could be a part of"),
}


def write_stiff(folder: Path, results: StiffResults, pictures: Mapping[str, StiffPictures]) -> Path:
    """Write `stiff.html` and `stiff.json` into `folder`, each in one step; gives the page's path."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in {"stiff.json": to_json(results), "stiff.html": render_stiff(results, pictures)}.items():
        partial = folder / f".{name}.{os.getpid()}.part"
        partial.write_text(text, encoding="utf-8")
        partial.replace(folder / name)
    return folder / "stiff.html"


def render_stiff(results: StiffResults, pictures: Mapping[str, StiffPictures]) -> str:
    """The page's text.

    Args:
        pictures: by scene; a scene that was refused has none.
    """
    import jinja2

    environment = jinja2.Environment(
        autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    cards = [_card(place, found, pictures.get(found.name)) for place, found in enumerate(results.scenes)]
    colours = colour_map(COLOURS)
    return environment.from_string(_asset("stiff.html")).render(
        style=_asset("report.css") + _asset("stiff.css"),
        cards=cards,
        tiles=_tiles(results),
        meanings=[(f"{mark} {name}", meaning) for name, (mark, meaning) in {**STATES, **DOUBTS}.items()],
        bar=png_uri(np.ascontiguousarray(colours.rgb[None])),
        nonfinite=_css(colours.nonfinite),
        magenta=_css(NOT_FINITE),
        same=f"{100 * SAME:.1g} %",
        device=[(key.replace("_", " "), "—" if value is None else value) for key, value in results.device.items()],
        results=results,
    )


def _tiles(results: StiffResults) -> list[dict[str, Any]]:
    """How many of each kind; what there is none of only where that is good news."""
    states, doubts = [state(found) for found in results.scenes], [doubt(found) for found in results.scenes]
    found = [{"name": name, "mark": mark, "count": states.count(name)} for name, (mark, _) in STATES.items()]
    found += [{"name": name, "mark": mark, "count": doubts.count(name)} for name, (mark, _) in DOUBTS.items()]
    return [tile for tile in found if tile["count"] or tile["name"] == "not finite"]


def _card(place: int, found: Finding, pictures: StiffPictures | None) -> dict[str, Any]:
    width, height = found.size
    return {
        "id": f"scene-{place}",
        "name": found.name,
        "what": found.what,
        "size": f"{width} × {height}",
        "shape": "wide" if width > 4 * height else "tall" if height > 4 * width else "",
        "chips": _chips(found),
        "views": _views(pictures),
        "figures": _figures(found),
        "words": found.words,
        "changes": [f"{effect} {_percent(share)}" for effect, share in blamed(found)],
        "lengths": found.lengths,
        "commands": found.commands,
        "seconds": f"{found.seconds:.1f} s",
    }


def _chips(found: Finding) -> list[dict[str, str]]:
    """What is to be seen at a glance: a mark, words, and a class for their colour."""
    chips = [(STATES[state(found)][0], state(found))]
    if why := doubt(found):
        chips.append((DOUBTS[why][0], why))
    if found.frame_changed is not None:
        if found.frame_changed >= SAME:
            chips.append(("≠", f"not as {found.like}"))
        else:
            chips.append(("=", "scale-invariant" if found.scale != 1 else f"as {found.like}"))
    kinds = {"✓": "good", "=": "good", "✕": "bad", "⊘": "plain"}
    return [{"mark": mark, "text": text, "kind": kinds.get(mark, "warn")} for mark, text in chips]


def _figures(found: Finding) -> list[tuple[str, str]]:
    figures = []
    if found.error is not None:
        low, high = (None if end is None else 100 * end for end in (found.low, found.high))
        figures.append(("nrmse", show_measurement(Measurement(100 * found.error, low, high, "%"))))
    figures.append(("noise of the reference", _percent(found.noise)))
    figures.append((f"frame against {found.like}", _percent(found.frame_changed)))
    figures.append((f"reference against {found.like}", _percent(found.truth_changed)))
    return [(name, text) for name, text in figures if text]


def _percent(share: float | None) -> str:
    return "" if share is None else f"{show_number(100 * share)} %"


def _views(pictures: StiffPictures | None) -> list[dict[str, str]]:
    """Name and picture of each view, "" where it cannot be drawn."""
    if pictures is None:
        return []
    error = "" if pictures.error is None else _heat_uri(pictures.error)
    views = (("real-time", _picture_uri(pictures.frame)), ("error", error), ("truth", _picture_uri(pictures.truth)))
    return [{"name": name, "uri": uri} for name, uri in views]


def _picture_uri(image: np.ndarray) -> str:
    small = reduced(image.astype(np.float64), None, SIDE)
    picture = np.round(255 * np.nan_to_num(np.clip(small, 0, 1))).astype(np.uint8)
    picture[~np.isfinite(small).all(axis=2)] = NOT_FINITE
    return png_uri(picture)


def _heat_uri(error: np.ndarray) -> str:
    small = reduced(error[..., None], None, SIDE)[..., 0]
    return png_uri(colourise(small, colour_map(COLOURS), 0.0, 1.0))


def _css(colour: tuple[int, int, int]) -> str:
    return "#{:02x}{:02x}{:02x}".format(*colour)


def _asset(name: str) -> str:
    return resources.files("lightmeter.reports.page").joinpath(name).read_text(encoding="utf-8")
