"""`lightmeter sweep SCENE EFFECT`: error against run time over an effect's knobs."""

import argparse
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from lightmeter import options
from lightmeter.candidates import words
from lightmeter.failures import UsageError
from lightmeter.progress import progress_bar


def add_options(parser: argparse.ArgumentParser) -> None:
    """Scene, effect, knobs, choice, budget, output."""
    options.add_scene(parser)
    parser.add_argument("effect", metavar="EFFECT", nargs="?", help="whose knobs are varied")
    parser.add_argument("--all", action="store_true", help="sweep every effect of the scene that has knobs to sweep")
    parser.add_argument(
        "--knob",
        metavar="NAME[=V,…]",
        action="append",
        default=[],
        help="vary this knob, over these values or its declared ones; several give their grid (default: every knob "
        "that declares values, one at a time)",
    )
    parser.add_argument(
        "--one-at-a-time", action="store_true", help="vary the knobs of --knob one at a time, not over their grid"
    )
    parser.add_argument(
        "--curve",
        type=options.number,
        metavar="S",
        default=60.0,
        help="seconds for the path tracer's own convergence curve (default 60)",
    )
    options.add_budget(parser)
    options.add_truth(parser)
    options.add_choice(parser)
    words.add_candidates(parser)
    parser.add_argument("-o", "--output", metavar="DIR", help="where it goes (default lightmeter-out/SCENE-sweep)")
    options.add_store(parser)
    options.add_json(parser)


def run(args: argparse.Namespace) -> int:
    """Measure, write the page, print the tables."""
    size, budget, chosen = options.size(args.size), options.budget(args), options.words(args)
    candidates = words.candidates(args)
    if bool(args.effect) == args.all:
        raise UsageError("sweep: name one EFFECT, or give --all")
    if not 0 <= args.curve <= 1e6:
        raise UsageError(f"--curve: expected 0 to 1e6 seconds, got {args.curve:g}")
    if args.all and args.knob:
        raise UsageError("--knob: names a knob of one effect, and cannot be given with --all")
    from lightmeter.realtime.discovery import effects
    from lightmeter.realtime.graph import Choice, compile_plan
    from lightmeter.sweeping import Sweeping, plan_visits

    scene = options.scene(args)
    choice = Choice(chosen.only, chosen.without, chosen.use, chosen.settings)
    wanted = plan_visits(scene, choice, args.effect, args.knob, grid=not args.one_at_a_time)
    folder = options.output_folder(args.output or f"lightmeter-out/{scene.name}-sweep")

    from lightmeter.groundtruth.store import Store
    from lightmeter.reports.sweep_page import write_sweep
    from lightmeter.truth import Truth

    with TemporaryDirectory() as scratch, progress_bar() as report:
        # Settings share oracles: without the store they are kept for this run.
        store = Store(Path(scratch)) if args.no_store else Store(say=options.say)
        how = {"store": store, "scattering": args.truth, "report": report, "say": options.say}
        drawn = compile_plan(scene, effects(), choice)
        truth = Truth(drawn.true_scene, size, budget, args.seed, **how)
        sweeping = Sweeping(wanted, choice, truth, args.curve, report, candidates)
        try:
            sweeping.run()
        except KeyboardInterrupt:
            if not sweeping.begun:
                raise
    sweep = sweeping.results()
    _print(sweep, write_sweep(folder, sweep), args.json)
    if not sweep.complete:
        raise KeyboardInterrupt
    return 0


def _print(sweep, page: Path, json: bool) -> None:
    """The tables, or sweep.json itself, on stdout; where the page is on stderr or at the end."""
    if json:
        from lightmeter.reports.results_json import to_json

        sys.stdout.write(to_json(sweep))
        print(f"page: {page}", file=sys.stderr)
        return
    from lightmeter.reports.sweep_table import sweep_tables
    from lightmeter.terminal import console

    console().print(sweep_tables(sweep))
    print(f"page: {page}")
