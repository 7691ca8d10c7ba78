"""`lightmeter store`: what the store holds, and how to make it smaller."""

import argparse
import json
import math
from typing import Any

from lightmeter import options
from lightmeter.failures import UsageError

CRITERIA = ("older_than", "larger_than", "key", "all")


def add_options(parser: argparse.ArgumentParser) -> None:
    """The action and what `prune` removes."""
    parser.add_argument("action", nargs="?", default="list", metavar="list|prune", help="default: list")
    parser.add_argument("--older-than", metavar="TIME", help="prune: what was not used for so long, such as 30d or 12h")
    parser.add_argument(
        "--larger-than", metavar="SIZE", help="prune: the longest unused until no more than this is left, such as 5GB"
    )
    parser.add_argument("--key", metavar="KEY", help="prune: what has a key that begins so")
    parser.add_argument("--all", action="store_true", help="prune: everything")
    options.add_json(parser)


def run(args: argparse.Namespace) -> int:
    """List or prune."""
    from lightmeter.groundtruth.store import Store

    asked = [f"--{name.replace('_', '-')}" for name in CRITERIA if getattr(args, name)]
    store = Store(say=options.say)
    if args.action == "list":
        if asked:
            raise UsageError(f"{asked[0]} says what to remove: expected `lightmeter store prune {asked[0]} …`")
        _show(store, store.entries(), "entries", "in", args.json)
    elif args.action == "prune":
        if not asked:
            raise UsageError("prune: expected what to remove: --older-than, --larger-than, --key or --all")
        _show(store, _pruned(store, args), "removed", "removed from", args.json)
    else:
        raise UsageError(f"store: expected list or prune, got {args.action!r}")
    return 0


def _pruned(store, args: argparse.Namespace) -> list:
    """The series that were removed."""
    from lightmeter.quantities import byte_count, duration

    older = duration(args.older_than, "--older-than") if args.older_than else None
    larger = byte_count(args.larger_than, "--larger-than") if args.larger_than else None
    if args.key and not any(entry.key.startswith(args.key) for entry in store.entries()):
        raise UsageError(f"--key: nothing in {store.folder} has a key that begins with {args.key!r}")
    return store.prune(older_than=-math.inf if args.all else older, larger_than=larger, key=args.key)


def _show(store, entries: list, title: str, relation: str, as_json: bool) -> None:
    """The entries and their sum, as a table or as one JSON document."""
    total = sum(entry.bytes for entry in entries)
    if as_json:
        found = {"folder": str(store.folder), "bytes": total, title: [_plain(entry) for entry in entries]}
        print(json.dumps(found, indent=2, ensure_ascii=False))
        return
    from rich.text import Text

    from lightmeter.quantities import counted, show_bytes
    from lightmeter.terminal import console

    out = console()
    if entries:
        out.print(_table(entries))
    batches = sum(entry.batches for entry in entries)
    summary = f"{show_bytes(total)} in {counted(batches, 'file')} of {counted(len(entries), 'series', 'series')} "
    out.print(Text(f"{summary}{relation} {store.folder}"), soft_wrap=True)


def _table(entries: list):
    """A row per series."""
    from rich import box
    from rich.table import Table
    from rich.text import Text

    from lightmeter.quantities import show_bytes, show_duration

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for name, justify in (("kind", "left"), ("scene", "left"), ("size", "right"), ("spp", "right")):
        table.add_column(name, justify=justify, overflow="fold")
    for name in ("files", "on disk", "unused for"):
        table.add_column(name, justify="right", no_wrap=True)
    table.add_column("key", no_wrap=True)
    for entry in entries:
        cells = (entry.kind, entry.scene, entry.size.replace("x", "×"), str(entry.spp), str(entry.batches))
        used = (show_bytes(entry.bytes), show_duration(entry.age), entry.key[:12])
        table.add_row(*(Text(cell) for cell in (*cells, *used)))
    return table


def _plain(entry) -> dict[str, Any]:
    """A series for JSON; `age` in seconds."""
    return {
        "kind": entry.kind,
        "scene": entry.scene,
        "size": entry.size,
        "spp": entry.spp,
        "batches": entry.batches,
        "bytes": entry.bytes,
        "age": round(entry.age, 3),
        "key": entry.key,
    }
