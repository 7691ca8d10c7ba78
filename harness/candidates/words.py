"""Candidates as the command line names them."""

import argparse
import re
import shlex
from dataclasses import replace
from pathlib import Path

from lightmeter import options
from lightmeter.candidates.candidate import CORRECTABLE, DEFAULT_TIMEOUT, FRAME, OWN, TRANSFERS, Candidate, Unsupported
from lightmeter.failures import UsageError
from lightmeter.hints import nearest

CONFIG = "lightmeter.toml"
"""Where candidates may be described once."""


def add_candidates(parser: argparse.ArgumentParser) -> None:
    """Frames of other renderers, and how they are meant."""
    group = parser.add_argument_group("frames of other renderers (docs/candidates.md)")
    group.add_argument(
        "--candidate",
        metavar="[NAME=]FILE",
        action="append",
        default=[],
        help=f"a frame as EXR, HDR or PNG, or the name of a [[candidate]] in {CONFIG}; may be repeated",
    )
    group.add_argument(
        "--candidate-command",
        metavar="[NAME=]COMMAND",
        action="append",
        default=[],
        help="a command that renders {gltf} with {camera_json} at {w}x{h} to {exr}; may be repeated",
    )
    group.add_argument(
        "--renderer", metavar="NAME", action="append", default=[], help="a renderer that an installed package registers"
    )
    group.add_argument("--transfer", metavar="|".join(TRANSFERS), help="how the candidates' values are encoded")
    group.add_argument(
        "--candidate-exposure", type=options.number, metavar="EV", help="stops that are in their images already"
    )
    group.add_argument(
        "--timeout", type=options.number, metavar="S", help=f"seconds for a command (default {DEFAULT_TIMEOUT:g})"
    )
    options.add_names(group, "--register", "FAULT", help=f"correct these before measuring: {', '.join(CORRECTABLE)}")
    group.add_argument("--no-background", action="store_true", help="leave out pixels that see no surface")


def candidates(args: argparse.Namespace, config: str = CONFIG) -> tuple[Candidate, ...]:
    """The candidates that are asked for, in the order of files, commands and renderers.

    Args:
        config: the file that may describe them.

    Raises:
        UsageError: a word makes no sense; names the nearest that does.
    """
    found = [*(_file(text, config) for text in args.candidate)]
    found += [_command(text) for text in args.candidate_command]
    found += [Candidate(name, "renderer", name) for name in args.renderer]
    found = [_with_options(candidate, args) for candidate in found]
    if not found:
        for word in ("transfer", "candidate_exposure", "timeout", "register"):
            if getattr(args, word):
                raise UsageError(f"--{word.replace('_', '-')}: there is no candidate that it could be of")
    if found:
        from lightmeter.candidates.gathering import check_all

        check_all(found)
    return tuple(found)


def _file(text: str, config: str) -> Candidate:
    """A file, or what the configuration describes under that name."""
    described = {} if Path(text).exists() or not Path(config).is_file() else configured(Path(config))
    if text in described:
        return described[text]
    name, rest = _named(text)
    if not name and not Path(rest).exists() and "{" not in rest:
        hint = f"; {nearest(rest, described)}" if described else ""
        raise UsageError(f"--candidate: there is no file {rest!r}, and no [[candidate]] of that name in {config}{hint}")
    path = Path(rest)
    return Candidate(name or (path.name if path.stem in (OWN, FRAME) else path.stem), "file", rest)


def configured(path: Path) -> dict[str, Candidate]:
    """Name to candidate, as lightmeter.toml describes them.

    Raises:
        SceneError: the file does not follow its schema.
    """
    from lightmeter.limits import read_candidates

    return {candidate.name: candidate for candidate in read_candidates(path)}


def _command(text: str) -> Candidate:
    name, rest = _named(text)
    if not name:
        try:
            words = shlex.split(rest)
        except ValueError:
            words = []  # `check_all` says what is wrong
        scripts = [word for word in words if not word.startswith("-") and not _is_interpreter(word)]
        path = Path(scripts[0]) if scripts else Path("command")
        # "examples/vtk/render.py" is better known by its folder.
        name = path.parent.name if path.stem in ("render", "main") and path.parent.name else path.stem
    return Candidate(name, "command", rest)


def _is_interpreter(word: str) -> bool:
    return re.fullmatch(r"(python[\d.]*|node|bash|sh|env|uv|run)", Path(word).name) is not None


def _named(text: str) -> tuple[str, str]:
    """NAME and the rest of "NAME=rest"; no name where there is none."""
    match = re.fullmatch(r"([\w][\w .+-]{0,59})=(.+)", text, re.DOTALL)
    if match is None or Path(text).exists():
        return "", text
    return match[1].strip(), match[2]


def _with_options(candidate: Candidate, args: argparse.Namespace) -> Candidate:
    """With what the command line says of all of them."""
    if args.transfer is not None:
        if args.transfer not in TRANSFERS:
            raise UsageError(f"--transfer: there is no transfer {args.transfer!r}; {nearest(args.transfer, TRANSFERS)}")
        candidate = replace(candidate, transfer=args.transfer)
    if args.candidate_exposure is not None:
        if abs(args.candidate_exposure) > 64:
            raise UsageError(f"--candidate-exposure: expected -64 to 64, got {args.candidate_exposure:g}")
        candidate = replace(candidate, exposure=args.candidate_exposure)
    if args.timeout is not None:
        options.check_seconds(args.timeout, "--timeout")
        candidate = replace(candidate, timeout=args.timeout)
    for fault in args.register:
        if fault == "background":
            raise UsageError("--register: a missing background cannot be made up; leave it out with --no-background")
        if fault not in CORRECTABLE:
            raise UsageError(f"--register: there is no fault {fault!r} to correct; {nearest(fault, CORRECTABLE)}")
    if args.register:
        candidate = replace(candidate, register=tuple(args.register))
    if args.no_background:
        candidate = replace(candidate, unsupported=candidate.unsupported | Unsupported(background=True))
    return candidate
