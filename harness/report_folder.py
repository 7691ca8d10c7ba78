"""A folder with everything that a report has: results.json, layers.exr, heatmaps, report.html."""

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from lightmeter.reports.display_curve import DisplayCurve
from lightmeter.reports.heatmap import write_heatmap
from lightmeter.reports.html import write_report
from lightmeter.reports.layers import write_layers
from lightmeter.reports.pictures import Pair
from lightmeter.reports.results import Results
from lightmeter.reports.results_json import write_json


def write_folder(folder: Path, results: Results, pairs: Sequence[Pair], curve: DisplayCurve | None = None) -> Path:
    """Write it all; gives the report's path. Each file is written in one step.

    Raises:
        OSError, ImageError: it cannot be written; names the file.
    """
    heatmaps = folder / "heatmaps"
    heatmaps.mkdir(parents=True, exist_ok=True)
    write_json(folder / "results.json", results)
    # Compression takes most of the time, and lets go of the interpreter.
    with ThreadPoolExecutor(2) as pool:
        report = pool.submit(write_report, folder, results, pairs, display_curve=curve)
        writing = [pool.submit(write_layers, folder / "layers.exr", pairs, {"scene": results.scene})]
        for pair in pairs:
            for error in pair.errors:
                path, title = heatmaps / f"{pair.name}.{error.name}.png", f"{pair.title}: {error.title}"
                writing.append(pool.submit(write_heatmap, path, error, title))
        for done in writing:
            done.result()
    return report.result()
