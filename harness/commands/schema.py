"""`lightmeter schema`: the JSON Schema of a scene file, for editors."""

import argparse
import json


def add_options(_parser: argparse.ArgumentParser) -> None:
    """None."""


def run(_args: argparse.Namespace) -> int:
    """Print it."""
    from lightmeter.scenes.toml import schema

    print(json.dumps(schema(), indent=2, ensure_ascii=False))
    return 0
