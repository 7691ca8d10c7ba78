"""`lightmeter compare SCENE`: the main job."""

import argparse
from pathlib import Path

from lightmeter import options
from lightmeter.candidates import words
from lightmeter.failures import USAGE_ERROR, UsageError
from lightmeter.groundtruth.scattering import MULTISCATTER, SINGLE
from lightmeter.progress import progress_bar


def add_options(parser: argparse.ArgumentParser) -> None:
    """Scene, choice, budget, output."""
    options.add_scene(parser)
    options.add_budget(parser)
    options.add_truth(parser, [options.BOTH])
    options.add_choice(parser)
    parser.add_argument("-o", "--output", metavar="DIR", help="where the report goes (default lightmeter-out/SCENE)")
    parser.add_argument("--reference", metavar="DIR", help="a reference that `lightmeter reference` wrote")
    parser.add_argument("--no-shares", action="store_true", help="do not share the frame's error out among the effects")
    words.add_candidates(parser)
    options.add_store(parser)
    options.add_json(parser)


def run(args: argparse.Namespace) -> int:
    """Compare, write the report, print the table."""
    size, budget, chosen = options.size(args.size), options.budget(args), options.words(args)
    candidates = words.candidates(args)
    usual, other = (SINGLE, MULTISCATTER) if args.truth == options.BOTH else (args.truth, None)
    if other and not candidates:
        raise UsageError(f"--truth {options.BOTH}: candidates are held against both; name one with --candidate")
    from lightmeter.groundtruth.store import Store
    from lightmeter.realtime.graph import Choice

    scene = options.scene(args)
    choice = Choice(chosen.only, chosen.without, chosen.use, chosen.settings)
    output = options.output_folder(args.output or f"lightmeter-out/{scene.name}")

    from lightmeter.comparison import compare
    from lightmeter.output import print_outcome, write_outcome

    store = None if args.no_store else Store(say=options.say)
    folder = Path(args.reference) if args.reference else None
    with progress_bar() as report:
        outcome = compare(
            scene,
            size,
            budget,
            args.seed,
            choice,
            store=store,
            folder=folder,
            scattering=usual,
            against=other,
            shares=not args.no_shares,
            report=report,
            say=options.say,
            candidates=candidates,
            candidates_folder=output / "candidates",
        )
        report("report", 0, 1)
        target = write_outcome(output, outcome)
        report("report", 1, 1)
    print_outcome(outcome, target, args.json)
    failed = outcome.results.failed_candidates
    for one in failed:
        options.say(f"error: candidate {one.name!r}: {one.why}")
    return USAGE_ERROR if failed else 0
