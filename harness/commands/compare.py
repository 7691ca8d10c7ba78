"""`lightmeter compare SCENE`: the main job."""

import argparse
from pathlib import Path

from lightmeter import options
from lightmeter.progress import progress_bar


def add_options(parser: argparse.ArgumentParser) -> None:
    """Scene, choice, budget, output."""
    options.add_scene(parser)
    options.add_budget(parser)
    options.add_choice(parser)
    parser.add_argument("-o", "--output", metavar="DIR", help="where the report goes (default lightmeter-out/SCENE)")
    parser.add_argument("--reference", metavar="DIR", help="a reference that `lightmeter reference` wrote")
    parser.add_argument("--no-shares", action="store_true", help="do not share the frame's error out among the effects")
    options.add_store(parser)
    options.add_json(parser)


def run(args: argparse.Namespace) -> int:
    """Compare, write the report, print the table."""
    size, budget, words = options.size(args.size), options.budget(args), options.words(args)
    from lightmeter.groundtruth.store import Store
    from lightmeter.realtime.graph import Choice
    from lightmeter.scenes.load import load

    scene = load(args.scene, args.camera)
    choice = Choice(words.only, words.without, words.use, words.settings)
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
            shares=not args.no_shares,
            report=report,
            say=options.say,
        )
        report("report", 0, 1)
        target = write_outcome(output, outcome)
        report("report", 1, 1)
    print_outcome(outcome, target, args.json)
    return 0
