"""The report as one HTML file that opens from disk, without network, in any current browser.

Style, scripts and HDR pictures are inside the file; see `page_file` for what it may do.
"""

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from lightmeter.reports.display_curve import DisplayCurve
from lightmeter.reports.embedded_data import pack_image, pack_mask
from lightmeter.reports.engine_strip import engine_strip
from lightmeter.reports.heatmap import colour_map, map_for
from lightmeter.reports.one_step import write_text
from lightmeter.reports.page_content import page_content
from lightmeter.reports.page_file import asset, script_hash, script_safe, template
from lightmeter.reports.pictures import ErrorMap, Pair
from lightmeter.reports.results import Results
from lightmeter.reports.thumbnails import data_uri, thumbnail

_SCRIPTS = ("inflate.js", "pictures.js", "viewer.js", "page.js")
_MARKED_PLACES = 64


def write_report(
    folder: str | os.PathLike[str],
    results: Results,
    pairs: Sequence[Pair],
    *,
    display_curve: DisplayCurve | None = None,
    thumbnails: Mapping[str, npt.NDArray[np.uint8]] | None = None,
) -> Path:
    """Write `report.html` into `folder`, which is made where it lacks, in one step; gives its path.

    Args:
        results: the numbers. Sections that have nothing are left out, so `diff` uses the same page.
        pairs: what the viewer shows; the first one at once. A pair named as an effect ("frame" for the frame) is
            opened by that effect's row; one named as an engine by the engine's row and pictures, and one named
            "<engine> <layer>" by the layer's row. Engines' pairs hold a "flip" map.
        display_curve: the frame's own display transform; without it scene-linear pictures are shown as sRGB.
        thumbnails: pair name to uint8 (h, w, 3), in place of one made from the tested picture.

    Raises:
        ValueError: two pairs of one name.
        OSError: the file cannot be written.
    """
    page = render_report(results, pairs, display_curve=display_curve, thumbnails=thumbnails)
    return write_text(Path(folder) / "report.html", page)


def render_report(
    results: Results,
    pairs: Sequence[Pair],
    *,
    display_curve: DisplayCurve | None = None,
    thumbnails: Mapping[str, npt.NDArray[np.uint8]] | None = None,
) -> str:
    """The page's text; see `write_report`."""
    names = [pair.name for pair in pairs]
    if len(set(names)) != len(names):
        raise ValueError(f"report: expected pairs of different names, found {', '.join(names)}")
    blobs: list[str] = []
    viewer = {
        "pairs": [_pair_model(pair, blobs) for pair in pairs],
        "curve": _curve_model(display_curve),
        "maps": _map_model(pairs),
    }
    script = "(() => {\n'use strict';\n" + "\n".join(asset(name) for name in _SCRIPTS) + "})();\n"
    content = page_content(results, set(names))
    return template("report.html").render(
        content,
        strip=engine_strip(results.candidates, pairs, display_curve),
        pairs=[_card(pair, display_curve, thumbnails or {}) for pair in pairs],
        style=asset("report.css") + (asset("candidates.css") if content["candidates"] else ""),
        script=script,
        script_hash=script_hash(script),
        viewer_json=script_safe(viewer),
        blobs=blobs,
        version=_version(),
    )


def _pair_model(pair: Pair, blobs: list[str]) -> dict[str, Any]:
    """What the viewer must know of a pair; the pictures go to `blobs`, and their numbers into the model."""
    return {
        "name": pair.name,
        "title": pair.title,
        "caption": pair.caption,
        "space": pair.space,
        "unit": pair.unit,
        "labels": list(pair.labels),
        "width": pair.size[0],
        "height": pair.size[1],
        "tested": _image_model(pair.tested, blobs),
        "truth": _image_model(pair.truth, blobs),
        "mask": _stored(pack_mask(pair.mask), blobs) if pair.mask is not None else None,
        "errors": [_error_model(error, blobs) for error in pair.errors],
    }


def _image_model(image: npt.NDArray[np.float32], blobs: list[str]) -> dict[str, Any]:
    packed = pack_image(image)
    bad = ~np.isfinite(image) if image.ndim == 2 else ~np.isfinite(image).all(axis=2)
    rows, columns = np.nonzero(bad)
    places = [[int(x), int(y)] for x, y in zip(columns[:_MARKED_PLACES], rows[:_MARKED_PLACES], strict=True)]
    return {
        "blob": _stored(packed.text, blobs),
        "exponent": packed.exponent,
        "channels": packed.channels,
        "bad": len(rows),
        "places": places,
    }


def _error_model(error: ErrorMap, blobs: list[str]) -> dict[str, Any]:
    low, high = error.range()
    return _image_model(error.values, blobs) | {
        "name": error.name,
        "title": error.title,
        "unit": error.unit,
        "scale": error.scale,
        "low": low,
        "high": high,
        "map": map_for(error).name,
    }


def _stored(text: str, blobs: list[str]) -> int:
    blobs.append(text)
    return len(blobs) - 1


def _curve_model(curve: DisplayCurve | None) -> dict[str, Any] | None:
    if curve is None:
        return None
    return {"name": curve.name, "x": list(curve.log2_input), "y": list(curve.display)}


def _map_model(pairs: Sequence[Pair]) -> dict[str, Any]:
    maps = {map_for(error).name for pair in pairs for error in pair.errors}
    model = {}
    for name in sorted(maps):
        colours = colour_map(name)
        model[name] = {"rgb": colours.rgb.tobytes().hex(), "nonfinite": list(colours.nonfinite)}
    return model


def _card(pair: Pair, curve: DisplayCurve | None, thumbnails: Mapping[str, npt.NDArray[np.uint8]]) -> dict[str, str]:
    """The button that opens a pair."""
    picture = thumbnails[pair.name] if pair.name in thumbnails else thumbnail(pair, curve)
    return {
        "name": pair.name,
        "title": pair.title,
        "terms": ", ".join(pair.terms),
        "picture": data_uri(picture),
    }


def _version() -> str:
    from importlib import metadata

    try:
        return metadata.version("lightmeter")
    except metadata.PackageNotFoundError:
        return ""
