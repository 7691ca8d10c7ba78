"""`lightmeter schema`: the JSON Schema of a scene file, for editors."""

import argparse
import json

from lightmeter import options


def add_options(parser: argparse.ArgumentParser) -> None:
    """Just --json, as every command has it: the schema is JSON in any case."""
    options.add_json(parser)


def run(_args: argparse.Namespace) -> int:
    """Print it."""
    from lightmeter.scenes.toml import schema

    print(json.dumps(schema(), indent=2, ensure_ascii=False))
    return 0
