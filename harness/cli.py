"""The command line: its words, its exit codes and its errors. Nothing heavy is imported before a command runs."""

import argparse
import os
import sys
from collections.abc import Sequence
from importlib import import_module

from lightmeter.failures import USAGE_ERROR, UsageError, explain, user_failures
from lightmeter.hints import nearest

COMMANDS = {
    "compare": "measure a real-time frame against the path-traced truth, effect by effect",
    "reference": "write the truth alone, as a folder that CI can cache or commit",
    "export": "write a scene as glTF, environment and camera.json, for another engine to draw",
    "sweep": "measure error against run time over an effect's knobs, beside the path tracer",
    "gate": "hold the limits of lightmeter.toml, and say which failed",
    "stress": "find the inputs at which shading functions lose digits or are not finite",
    "diff": "compare two images on disk",
    "scenes": "list the scenes there are",
    "effects": "list the effects there are, or explain one",
    "store": "list or prune the stored references and oracles",
    "schema": "print the JSON Schema of a scene file",
    "doctor": "say what this machine has, and the command for what it lacks",
}

INTERRUPTED = 130


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; the exit code: 0 held, 1 a limit failed, 2 a usage or input error, 3 undecided."""
    args = sys.argv[1:] if arguments is None else list(arguments)
    try:
        options = _parse(args)
        if options is None:
            return USAGE_ERROR
        return import_module(f"lightmeter.commands.{options.command}").run(options)
    except SystemExit as stop:  # argparse has printed the help
        return int(stop.code or 0)
    except KeyboardInterrupt:
        print("lightmeter: interrupted; finished batches are kept", file=sys.stderr)
        return INTERRUPTED
    except BrokenPipeError:  # the reader has gone; Python would complain at exit that it cannot flush
        with open(os.devnull, "w") as nowhere:  # noqa: PTH123
            os.dup2(nowhere.fileno(), sys.stdout.fileno())
        return 0
    except Exception as error:
        if not isinstance(error, user_failures()):
            raise
        print(f"lightmeter: error: {explain(error)}", file=sys.stderr)
        return USAGE_ERROR


class Parser(argparse.ArgumentParser):
    """A parser whose errors are exceptions, like all others of the command line."""

    def error(self, message: str):
        """Raises UsageError in place of printing the usage and leaving the process."""
        raise UsageError(f"{message.removeprefix('argument ')}; see `{self.prog} --help`")


class Version(argparse.Action):
    """Prints the version, which is looked up only then."""

    def __init__(self, *where, **how):
        super().__init__(*where, nargs=0, **how)

    def __call__(self, parser, *_rest):
        """Raises SystemExit, as `--help` does."""
        from importlib.metadata import version

        print(f"lightmeter {version('lightmeter')}")
        parser.exit()


def _parse(args: list[str]) -> argparse.Namespace | None:
    """The options; None where no command was given, and the help is printed instead.

    Raises:
        UsageError: the command or an option does not exist, or an option's value is of another kind.
    """
    name = next((a for a in args if not a.startswith("-")), None)
    if name is not None and name not in COMMANDS:
        raise UsageError(f"there is no command {name!r}; {nearest(name, COMMANDS)}")
    parser = _parser(name)
    options, surplus = parser.parse_known_args(args)
    if surplus:
        known = [option for option in _options(parser, name) if option.startswith("--")]
        unknown = next((a for a in surplus if a.startswith("-")), None)
        if unknown is None:
            raise UsageError(f"{surplus[0]!r} is one argument too many; see `lightmeter {name} --help`")
        raise UsageError(f"{name or 'lightmeter'} has no option {unknown!r}; {nearest(unknown.split('=')[0], known)}")
    if options.command is None:
        parser.print_help(sys.stderr)
        return None
    return options


def _options(parser: argparse.ArgumentParser, name: str | None) -> list[str]:
    """The option strings of a command, or of the parser itself."""
    actions = parser._actions
    if name is not None:
        subparsers = next(a for a in actions if isinstance(a, argparse._SubParsersAction))
        actions = subparsers.choices[name]._actions
    return [option for action in actions for option in action.option_strings]


def _parser(name: str | None) -> argparse.ArgumentParser:
    """The parser; only the named command's options are imported."""
    parser = Parser(
        prog="lightmeter",
        allow_abbrev=False,
        description="Measures how far a real-time frame is from the light that physics would give.",
        epilog="`lightmeter COMMAND --help` explains a command.",
    )
    parser.add_argument("--version", action=Version, help="print the version and exit")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND")
    for command, summary in COMMANDS.items():
        description = summary[0].upper() + summary[1:] + "."
        sub = commands.add_parser(command, help=summary, description=description, allow_abbrev=False)
        if command == name:
            import_module(f"lightmeter.commands.{command}").add_options(sub)
    return parser
