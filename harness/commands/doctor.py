"""`lightmeter doctor`: what this machine has, and the exact command for what it lacks."""

import argparse

from lightmeter import options


def add_options(parser: argparse.ArgumentParser) -> None:
    """Just --json."""
    options.add_json(parser)


def run(args: argparse.Namespace) -> int:
    """Examine and report; 0 when all is there, else 1."""
    from lightmeter import doctor

    return doctor.run(args.json)
