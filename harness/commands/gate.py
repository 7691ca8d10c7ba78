"""`lightmeter gate [SCENE…]`: hold the limits of lightmeter.toml."""

import argparse
import json
import math
import re
from pathlib import Path
from typing import Any

from lightmeter import options
from lightmeter.failures import UsageError
from lightmeter.progress import progress_bar

CONFIG = "lightmeter.toml"
HELD, FAILED, UNDECIDED = 0, 1, 3


def add_options(parser: argparse.ArgumentParser) -> None:
    """Scenes, limits, output."""
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="just these of the scenes that have limits")
    parser.add_argument("--config", metavar="FILE", default=CONFIG, help="the limits (default %(default)s)")
    parser.add_argument("--junit", metavar="FILE", help="write the verdicts as JUnit XML")
    parser.add_argument("--strict", action="store_true", help="exit with 3 where a limit is undecided")
    parser.add_argument("-o", "--output", metavar="DIR", help="write every comparison's report there")
    options.add_store(parser)
    options.add_json(parser)


def run(args: argparse.Namespace) -> int:
    """Compare, judge, tell: 0 all held, 1 one failed, 3 one is undecided and that is not allowed."""
    config = Path(args.config)
    if not config.exists():
        raise UsageError(f"{config}: there is no such file; it holds the limits, name it with --config")
    junit = _writable(Path(args.junit)) if args.junit else None
    folder = options.output_folder(args.output) if args.output else None
    from lightmeter.gating import plan_tasks, run_tasks
    from lightmeter.groundtruth.store import Store
    from lightmeter.limits import read_limits
    from lightmeter.reports.junit import write_junit

    tasks = plan_tasks(read_limits(config), config, args.scenes)
    store = None if args.no_store else Store(say=options.say)
    found = []
    with progress_bar() as report:
        for judged in run_tasks(tasks, store, report, options.say):
            found += [(judged.task, *pair) for pair in zip(judged.task.limits, judged.verdicts, strict=True)]
            if folder is not None:
                from lightmeter.output import write_outcome

                write_outcome(folder / _file_name(judged.task.name), judged.outcome)
    verdicts = [verdict for _, _, verdict in found]
    if junit is not None:
        write_junit(junit, verdicts, strict=args.strict)
    code = _exit_code(verdicts, args.strict)
    if args.json:
        print(json.dumps(_document(found, code), indent=2, ensure_ascii=False))
    else:
        _print_verdicts(verdicts)
    undecided = sum(v.status == "UNDECIDED" for v in verdicts)
    if undecided:
        options.say(f"{undecided} of {len(verdicts)} limits undecided: a larger spp narrows the intervals")
    return code


def _exit_code(verdicts, strict: bool) -> int:
    statuses = {verdict.status for verdict in verdicts}
    if "FAIL" in statuses:
        return FAILED
    return UNDECIDED if strict and "UNDECIDED" in statuses else HELD


def _document(found, code: int) -> dict[str, Any]:
    """The verdicts for JSON. A number that is not finite is text, as in results.json."""
    statuses = [verdict.status for _, _, verdict in found]
    return {
        "exit": code,
        "passed": statuses.count("PASS"),
        "failed": statuses.count("FAIL"),
        "undecided": statuses.count("UNDECIDED"),
        "verdicts": [
            {
                "scene": task.name,
                "of": limit.of,
                "metric": limit.metric,
                "max": limit.high,
                "min": limit.low,
                "status": verdict.status,
                **{k: _number(getattr(verdict.measurement, k)) for k in ("value", "low", "high", "corrected")},
                "unit": verdict.measurement.unit,
                "message": verdict.message,
                "seconds": round(verdict.seconds, 3),
            }
            for task, limit, verdict in found
        ],
    }


def _number(value: float | None) -> float | str | None:
    if value is None or math.isfinite(value):
        return value
    return "NaN" if math.isnan(value) else "Infinity" if value > 0 else "-Infinity"


def _print_verdicts(verdicts) -> None:
    """A row per limit, then the sums."""
    from rich import box
    from rich.table import Table
    from rich.text import Text

    from lightmeter.reports.significant import show_measurement, show_number
    from lightmeter.terminal import console

    styles = {"PASS": "green", "FAIL": "bold red", "UNDECIDED": "yellow"}
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    table.add_column("verdict", no_wrap=True)
    table.add_column("of", overflow="fold")
    table.add_column("limit", no_wrap=True)
    table.add_column("measured", overflow="fold")
    for verdict in verdicts:
        measurement = verdict.measurement
        shown = show_measurement(measurement)
        if measurement.low is None:  # the value as exactly as a limit may be written
            shown = f"{show_number(measurement.value, 5)} {measurement.unit}".strip()
        if measurement.corrected is not None:
            shown += f" (corrected {show_number(measurement.corrected, 5)})"
        table.add_row(
            Text(verdict.status, style=styles[verdict.status]),
            Text(verdict.name.rpartition("/")[0]),
            Text(str(verdict.limit)),
            Text(shown),
        )
    out = console()
    out.print(table)
    counts = [f"{sum(v.status == status for v in verdicts)} {status}" for status in styles]
    out.print(", ".join(counts), highlight=False)


def _file_name(task: str) -> str:
    """A folder's name for a task."""
    return re.sub(r"[^\w.=+-]+", "-", task).strip("-.") or "scene"


def _writable(path: Path) -> Path:
    """The JUnit file's path, once its folder can be written to."""
    if path.is_dir():
        raise UsageError(f"--junit: expected a file to write, got the folder {path}")
    options.output_folder(path.parent)
    return path
