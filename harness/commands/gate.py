"""`lightmeter gate [SCENE…]`: hold the limits of lightmeter.toml."""

import argparse
import json
import re
import time
from dataclasses import replace
from math import isnan
from pathlib import Path

from lightmeter import options
from lightmeter.candidates import words
from lightmeter.failures import UsageError
from lightmeter.groundtruth.scattering import SCATTERINGS
from lightmeter.progress import progress_bar

CONFIG = "lightmeter.toml"
HELD, FAILED, UNDECIDED = 0, 1, 3


def add_options(parser: argparse.ArgumentParser) -> None:
    """Scenes, limits, budget, output."""
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="just these of the scenes that have limits")
    parser.add_argument("--config", metavar="FILE", default=CONFIG, help="the limits (default %(default)s)")
    parser.add_argument("--seconds", type=options.number, metavar="S", help="time for all verdicts together")
    parser.add_argument(
        "--confidence", type=options.number, metavar="C", help="that no verdict is wrong (default: the file's or 0.999)"
    )
    parser.add_argument("--truth", choices=tuple(SCATTERINGS), help="in place of the truth that the limits name")
    parser.add_argument("--update", action="store_true", help="write the baseline that regressions are held against")
    parser.add_argument("--strict", action="store_true", help="exit with 3 where a limit is undecided")
    parser.add_argument("--junit", metavar="FILE", help="write the verdicts as JUnit XML")
    parser.add_argument("--markdown", metavar="FILE", help="write them for a pull request, heatmaps beside it")
    parser.add_argument("--json-file", metavar="FILE", help="write them as JSON")
    parser.add_argument("-o", "--output", metavar="DIR", help="write every comparison's full report there (slow)")
    words.add_candidates(parser)
    options.add_store(parser)
    options.add_json(parser)


def run(args: argparse.Namespace) -> int:
    """Draw, judge, tell: 0 all held, 1 one failed, 3 one is undecided and that is not allowed."""
    config = Path(args.config)
    if not config.exists():
        raise UsageError(f"{config}: there is no such file; it holds the limits, name it with --config")
    options.check_seconds(args.seconds)
    options.check_confidence(args.confidence)
    files = {name: _writable(getattr(args, name), name) for name in ("junit", "markdown", "json_file")}
    folder = options.output_folder(args.output) if args.output else None
    from lightmeter.baseline import read_baseline
    from lightmeter.gating import decide
    from lightmeter.groundtruth.store import Store
    from lightmeter.limits import read_rules
    from lightmeter.planning import plan_cases
    from lightmeter.trials import start_trials

    rules = read_rules(config)
    confidence = rules.confidence if args.confidence is None else args.confidence
    seconds = rules.seconds if args.seconds is None else args.seconds
    asked = words.candidates(args, args.config)
    limits, candidates = _on_candidates(rules, asked)
    if rules.stress and not asked:
        from lightmeter.stiff_limits import error_limits

        limits += error_limits([entry for entry in rules.stress if entry.scene])
    if args.truth:
        limits = tuple(_under(limit, args.truth) for limit in limits)
    store = None if args.no_store else Store(say=options.say)
    pairs = plan_cases(limits, config, args.scenes, store, candidates) if limits else []
    if args.update:
        return _update(pairs, rules.baseline, confidence, seconds)
    start = time.perf_counter()
    trials = start_trials(pairs, confidence, read_baseline(rules.baseline))
    with progress_bar() as report:
        stressed = _stress(rules.stress, args, config, report)  # first: a wrong name is told at once
        verdicts = [*decide(trials, seconds, report), *stressed]
    code = _exit_code(verdicts, args.strict)
    document = _document(verdicts, code, confidence, time.perf_counter() - start)
    if folder is not None:
        _write_reports(folder, trials)
    _write_files(files, verdicts, trials, document, args.strict)
    if args.json:
        print(json.dumps(document, indent=2, ensure_ascii=False))
    else:
        _print_verdicts(verdicts, document)
    for verdict in verdicts:
        if verdict.status == "FAIL" and verdict.measurement is not None and _needs_words(verdict):
            options.say(verdict.message)
    undecided = document["undecided"]
    if undecided:
        options.say(f"{undecided} of {len(verdicts)} limits undecided: {_first_reason(verdicts)}")
    return code


def _on_candidates(rules, asked):
    """The limits and the candidates they may be on: where the command line names any, its frames stand in for ours."""
    known = {candidate.name: candidate for candidate in (*rules.candidates, *asked)}
    if not asked:
        return rules.limits, tuple(known.values())
    from lightmeter.limit import FRAME

    names = [candidate.name for candidate in asked]
    ours = [limit for limit in rules.limits if limit.candidate is None and limit.of == FRAME and not limit.is_time]
    limits = [replace(limit, candidate=name) for name in names for limit in ours]
    limits += [limit for limit in rules.limits if limit.candidate in names]
    if dropped := sum(limit.candidate not in names and limit not in ours for limit in rules.limits):
        options.say(f"{dropped} limits that are not on a frame of {', '.join(names)} are left out")
    if not limits:
        raise UsageError(f"{rules.limits[0].place}: none of the limits is on a frame, which is what a candidate has")
    return tuple(limits), tuple(known.values())


def _under(limit, truth: str):
    """The limit by another truth. Its name says so: what a baseline holds is of one truth."""
    if limit.conditions.scattering == truth:
        return limit
    variant = ", ".join(part for part in (limit.variant, f"truth {truth}") if part)
    return replace(limit, conditions=replace(limit.conditions, scattering=truth), variant=variant)


def _needs_words(verdict) -> bool:
    """Whether the number does not explain a failure: there is none, or it is one input's of many."""
    return isnan(verdict.measurement.value) or verdict.scene == "stress"


def _stress(entries, args: argparse.Namespace, config: Path, report) -> list:
    """The verdicts on shading functions and stiff scenes; none where the run is narrowed to scenes or a candidate.

    Raises:
        UsageError: a limit is on what does not exist, or reaches no input; names the file.
    """
    if not entries or args.scenes or words.candidates(args, args.config):
        return []
    from lightmeter.realtime.effect import EffectError
    from lightmeter.stiff_limits import judge_scenes
    from lightmeter.stress_limits import judge_all

    functions = [entry for entry in entries if not entry.scene]
    try:
        return [*judge_all(functions, report), *judge_scenes([e for e in entries if e.scene], config, report)]
    except (EffectError, UsageError) as error:
        raise UsageError(f"{config}: stress: {error}") from None


def _update(pairs, path: Path, confidence: float, seconds: float | None) -> int:
    """Write the baseline of the regressions among the limits; 1 where one has no trustworthy value."""
    from lightmeter.baseline_update import update

    regressions = [(limit, case) for limit, case in pairs if limit.regression is not None]
    if not regressions:
        raise UsageError("--update: none of these limits is a regression; write regression = 0.02 in place of max")
    with progress_bar() as report:
        lines, refused = update(regressions, path, confidence, seconds, report)
    for line in lines:
        print(line)
    for line in refused:
        options.say(line)
    return FAILED if refused else HELD


def _exit_code(verdicts, strict: bool) -> int:
    statuses = {verdict.status for verdict in verdicts}
    if "FAIL" in statuses:
        return FAILED
    return UNDECIDED if strict and "UNDECIDED" in statuses else HELD


def _document(verdicts, code: int, confidence: float, seconds: float) -> dict:
    from lightmeter.reports.gate_json import to_document

    return {"exit": code, "confidence": confidence, "seconds": round(seconds, 3), **to_document(verdicts)}


def _write_files(files: dict[str, Path | None], verdicts, trials, document: dict, strict: bool) -> None:
    if path := files["junit"]:
        from lightmeter.reports.junit import write_junit

        write_junit(path, verdicts, strict=strict)
    if path := files["json_file"]:
        path.write_text(json.dumps(document, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
    if path := files["markdown"]:
        from lightmeter.gate_pictures import error_maps
        from lightmeter.reports.gate_markdown import write_markdown

        write_markdown(path, verdicts, error_maps(trials), document["confidence"], document["seconds"])


def _write_reports(folder: Path, trials) -> None:
    """A full comparison of every case, with as many samples as its verdicts took."""
    from lightmeter.cases import choice_of
    from lightmeter.comparison import compare
    from lightmeter.options import Budget
    from lightmeter.output import write_outcome

    spp: dict = {}
    for trial in trials:
        taken = 0 if trial.limit.is_time else trial.verdict.samples
        spp[trial.case] = max(spp.get(trial.case, options.DEFAULT_SPP), taken)
    for case, samples in spp.items():
        c = case.conditions
        place = folder / _file_name(case.name)
        names = dict.fromkeys(t.limit.candidate for t in trials if t.case is case and t.limit.candidate)
        outcome = compare(
            case.scene,
            c.size,
            Budget(samples),
            c.seed,
            choice_of(c),
            store=case.store,
            scattering=c.scattering,
            say=options.say,
            candidates=[case.candidates[name] for name in names if case.gave(name)],
            candidates_folder=place / "candidates",
        )
        write_outcome(place, outcome)


def _print_verdicts(verdicts, document: dict) -> None:
    """A row per limit, then the sums."""
    from lightmeter.reports.gate_table import verdict_table
    from lightmeter.terminal import console

    out = console()
    out.print(verdict_table(verdicts))
    counts = ", ".join(f"{document[key]} {word}" for key, word in _COUNTS)
    out.print(f"{counts}; {document['seconds']:.1f} s at confidence {document['confidence']:g}", highlight=False)


_COUNTS = (("passed", "PASS"), ("failed", "FAIL"), ("undecided", "UNDECIDED"))


def _first_reason(verdicts) -> str:
    reasons = [verdict.reason for verdict in verdicts if verdict.reason]
    return reasons[0] if reasons else "see the table"


def _file_name(case: str) -> str:
    """A folder's name for a case."""
    return re.sub(r"[^\w.=+-]+", "-", case).strip("-.") or "scene"


def _writable(text: str | None, option: str) -> Path | None:
    """The file's path, once its folder can be written to."""
    if not text:
        return None
    path = Path(text)
    if path.is_dir():
        raise UsageError(f"--{option.replace('_', '-')}: expected a file to write, got the folder {path}")
    options.output_folder(path.parent)
    return path
