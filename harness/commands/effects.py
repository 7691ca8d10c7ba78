"""`lightmeter effects [NAME]`: what there is, and what one is about."""

import argparse
import json
from typing import Any

from lightmeter import options


def add_options(parser: argparse.ArgumentParser) -> None:
    """An effect's name, and --json."""
    parser.add_argument("name", nargs="?", metavar="NAME", help="explain this effect with its knobs")
    parser.add_argument("--markdown", action="store_true", help="print the reference page of docs/effects.md")
    options.add_json(parser)


def run(args: argparse.Namespace) -> int:
    """List the effects, or explain one."""
    from lightmeter.realtime import discovery

    chosen = [discovery.effect(args.name)] if args.name else list(discovery.effects().values())
    if args.json:
        print(json.dumps([description(effect) for effect in chosen], indent=2, ensure_ascii=False))
    elif args.markdown:
        print(markdown(chosen), end="")
    elif args.name:
        _explain(chosen[0])
    else:
        _list(chosen)
    return 0


def description(effect) -> dict[str, Any]:
    """An effect as the JSON of section 6 of the design."""
    knobs = [
        {"name": k.name, "default": k.default, "unit": k.unit, "range": k.range, "help": k.help} for k in effect.knobs
    ]
    return {
        "name": effect.name,
        "terms": list(effect.terms),
        "summary": effect.summary,
        "citation": effect.citation,
        "knobs": knobs,
        "bytes_per_pixel": effect.bytes_per_pixel(effect.settings({})),
    }


def markdown(effects) -> str:
    """The effects' reference as Markdown, made from their declarations."""
    from lightmeter.realtime.effect import STAGES
    from lightmeter.scenes.terms import TERMS

    lines = ["# Effects", "", "Made by `lightmeter effects --markdown` from the effects' own declarations.", ""]
    for effect in effects:
        lines += [f"## {effect.name}", "", effect.summary, ""]
        lines += [f"- approximates **{term}**: {TERMS[term].meaning}" for term in effect.terms]
        lines += [f"- works on {STAGES[effect.stage]}"] if "coverage" in effect.terms else []
        lines += [f"- source: {effect.citation}"]
        if stored := effect.bytes_per_pixel(effect.settings({})):
            lines += [f"- what it stores takes {stored} bytes per pixel at its defaults"]
        lines += [""]
        if effect.knobs:
            lines += ["| knob | default | unit | range | what it does |", "| --- | --- | --- | --- | --- |"]
            for knob in effect.knobs:
                values = knob.range.replace("|", "\\|")
                lines.append(f"| `{knob.name}` | {knob.default} | {knob.unit} | {values} | {knob.help} |")
            lines.append("")
    return "\n".join(lines).rstrip() + "\n"


def _list(effects) -> None:
    from rich.table import Table

    from lightmeter.terminal import console

    table = Table(title="Effects", title_justify="left")
    table.add_column("effect", style="bold", no_wrap=True)
    table.add_column("terms", no_wrap=True)
    table.add_column("what it does")
    for effect in effects:
        table.add_row(effect.name, "\n".join(effect.terms), effect.summary)
    console().print(table)


def _explain(effect) -> None:
    from rich.table import Table

    from lightmeter.realtime.effect import STAGES
    from lightmeter.scenes.terms import TERMS
    from lightmeter.terminal import console

    out = console()
    out.print(f"[bold]{effect.name}[/bold]: {effect.summary}\n")
    for term in effect.terms:
        out.print(f"approximates [bold]{term}[/bold]: {TERMS[term].meaning}")
    if "coverage" in effect.terms:
        out.print(f"works on {STAGES[effect.stage]}")
    out.print(f"source: {effect.citation}\n")
    if stored := effect.bytes_per_pixel(effect.settings({})):
        out.print(f"What it stores takes {stored} bytes per pixel at its defaults.\n")
    if not effect.knobs:
        out.print("It has no knobs.")
        return
    table = Table()
    for column in ("knob", "default", "unit", "range", "what it does"):
        table.add_column(column, no_wrap=column == "knob")
    for knob in effect.knobs:
        table.add_row(knob.name, str(knob.default), knob.unit, knob.range, knob.help)
    out.print(table)
