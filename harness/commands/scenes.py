"""`lightmeter scenes`: the library."""

import argparse
import json

from lightmeter import options


def add_options(parser: argparse.ArgumentParser) -> None:
    """Just --json."""
    options.add_json(parser)


def run(args: argparse.Namespace) -> int:
    """List the built-in scenes with what each isolates."""
    from lightmeter.scenes import library

    found = [{"name": name, "summary": library.summary(name)} for name in library.names()]
    if args.json:
        print(json.dumps(found, indent=2, ensure_ascii=False))
        return 0
    from rich.table import Table

    from lightmeter.terminal import console

    table = Table(title="Built-in scenes", title_justify="left")
    table.add_column("scene", style="bold", no_wrap=True)
    table.add_column("what it isolates")
    for item in found:
        table.add_row(item["name"], item["summary"])
    console().print(table)
    return 0
