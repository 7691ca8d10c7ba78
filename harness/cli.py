"""The command line: its words, its exit codes and its errors. Nothing heavy is imported before a command runs."""

import argparse
import sys
from collections.abc import Sequence
from importlib import import_module

from lightmeter.failures import user_failures

COMMANDS = {
    "compare": "measure a real-time frame against the path-traced truth, effect by effect",
    "reference": "write the truth alone, as a folder that CI can cache or commit",
    "gate": "hold the limits of lightmeter.toml, and say which failed",
    "diff": "compare two images on disk",
    "scenes": "list the scenes there are",
    "effects": "list the effects there are, or explain one",
    "store": "list or prune the stored references and oracles",
    "schema": "print the JSON Schema of a scene file",
    "doctor": "say what this machine has, and the command for what it lacks",
}

USAGE_ERROR = 2
INTERRUPTED = 130


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; the exit code: 0 held, 1 a limit failed, 2 a usage or input error, 3 undecided."""
    args = sys.argv[1:] if arguments is None else list(arguments)
    name = next((a for a in args if not a.startswith("-")), None)
    parser = _parser(name)
    try:
        options = parser.parse_args(args)
    except SystemExit as stop:  # argparse has printed its message, or the help
        return int(stop.code or 0)
    if options.command is None:
        parser.print_help()
        return USAGE_ERROR
    try:
        return import_module(f"lightmeter.commands.{options.command}").run(options)
    except KeyboardInterrupt:
        print("lightmeter: interrupted; finished batches are kept", file=sys.stderr)
        return INTERRUPTED
    except BrokenPipeError:
        sys.stderr.close()
        return 0
    except Exception as error:
        if not isinstance(error, user_failures()):
            raise
        print(f"lightmeter: error: {error}", file=sys.stderr)
        return USAGE_ERROR


def _parser(name: str | None) -> argparse.ArgumentParser:
    """The parser; only the named command's options are imported."""
    parser = argparse.ArgumentParser(
        prog="lightmeter",
        description="Measures how far a real-time frame is from the light that physics would give.",
        epilog="`lightmeter COMMAND --help` explains a command.",
    )
    commands = parser.add_subparsers(dest="command", metavar="COMMAND")
    for command, summary in COMMANDS.items():
        sub = commands.add_parser(command, help=summary, description=summary[0].upper() + summary[1:] + ".")
        if command == name:
            import_module(f"lightmeter.commands.{command}").add_options(sub)
    return parser
