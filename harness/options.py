"""Options that several commands share."""

import argparse
import math
import os
import re
import sys
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from lightmeter.failures import UsageError
from lightmeter.groundtruth.scattering import SCATTERINGS, SINGLE

DEFAULT_SIZE = "512x512"
DEFAULT_SPP = 64
DEFAULT_CONFIDENCE = 0.999
MIN_BATCHES = 8
MAX_SPP = 1 << 20
BOTH = "both"
"""In place of a truth: the usual one, and candidates against the other as well."""


@dataclass(frozen=True)
class Budget:
    """What the truth may cost.

    Attributes:
        spp: samples per pixel of the reference and of every oracle, spread over the batches; None: by time.
        seconds: time for the reference, None: by samples.
        least: how many independent batches at least.
    """

    spp: int | None = DEFAULT_SPP
    seconds: float | None = None
    least: int = MIN_BATCHES

    @property
    def spp_per_batch(self) -> int:
        """Samples per pixel of one batch."""
        return max(1, (self.spp or DEFAULT_SPP) // self.least)

    @property
    def batches(self) -> int:
        """How many batches of that size come closest to the samples asked for without exceeding them."""
        return max(self.least, (self.spp or DEFAULT_SPP) // self.spp_per_batch)


@dataclass(frozen=True)
class Words:
    """The choice of effects as the command line says it."""

    only: tuple[str, ...] = ()
    without: tuple[str, ...] = ()
    use: tuple[str, ...] = ()
    settings: dict[str, dict[str, Any]] = field(default_factory=dict)


def add_scene(parser: argparse.ArgumentParser) -> None:
    """The scene, the camera of a glTF file, and the size."""
    parser.add_argument("scene", metavar="SCENE", help="a library name, a .toml, a .glb or .gltf file")
    parser.add_argument("--camera", metavar="NAME", help="which of a glTF file's cameras, by name or number")
    parser.add_argument("--size", metavar="WxH", default=DEFAULT_SIZE, help="in pixels (default %(default)s)")
    parser.add_argument(
        "--environment",
        metavar="FILE",
        help="a latitude-longitude map, .hdr or .exr, in place of the scene's own; or a built-in one: sky, studio",
    )
    parser.add_argument(
        "--rotate", type=number, metavar="DEG", default=0.0, help="turn it about +Y, anticlockwise from above"
    )
    parser.add_argument(
        "--environment-clamp", action="store_true", help="mend texels that are negative or not finite, and say so"
    )


def add_budget(parser: argparse.ArgumentParser) -> None:
    """Samples, time and seed of the truth."""
    parser.add_argument(
        "--spp", type=whole, metavar="N", help=f"samples per pixel of the truth (default {DEFAULT_SPP})"
    )
    parser.add_argument("--seconds", type=number, metavar="S", help="render the reference for S seconds instead")
    parser.add_argument("--seed", type=whole, default=0, metavar="N", help="names the random numbers (default 0)")


def add_truth(parser: argparse.ArgumentParser, more: Sequence[str] = ()) -> None:
    """Which truth; `more` are words beside the truths."""
    parser.add_argument(
        "--truth",
        choices=[*SCATTERINGS, *more],
        default=SINGLE,
        help="what rough surfaces do with light between their facets: lost after one bounce, as glTF defines it, or "
        "followed until it leaves"
        + (f"; {BOTH}: candidates against either" if BOTH in more else "")
        + " (default %(default)s)",
    )


def add_choice(parser: argparse.ArgumentParser) -> None:
    """Which effects take part, with which knobs."""
    add_names(parser, "--only", "EFFECT", help="take just these effects")
    add_names(parser, "--without", "EFFECT", help="leave these effects out")
    add_names(parser, "--use", "EFFECT", help="prefer these among effects for the same term")
    parser.add_argument(
        "--set", metavar="EFFECT.KNOB=VALUE", action="append", default=[], help="set a knob; may be repeated"
    )


def add_names(parser: argparse._ActionsContainer, option: str, what: str, *, help: str) -> None:
    """A list of names with commas; given more than once, the lists are one."""
    parser.add_argument(option, metavar=f"{what},…", type=names, action="extend", default=[], help=help)


def add_json(parser: argparse.ArgumentParser) -> None:
    """One JSON document on stdout."""
    parser.add_argument("--json", action="store_true", help="print one JSON document on stdout")


def add_store(parser: argparse.ArgumentParser) -> None:
    """Whether the store takes part."""
    parser.add_argument("--no-store", action="store_true", help="neither read nor write the store")


def whole(text: str) -> int:
    """A whole number, for `type=`."""
    try:
        return int(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"expected a whole number, got {text!r}") from None


def number(text: str) -> float:
    """A finite number, for `type=`."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"expected a number, got {text!r}")
    return value


def size(text: str, what: str = "--size") -> tuple[int, int]:
    """Width and height from "WxH"; `what` is what the message calls it.

    Raises:
        UsageError: where it is not two whole numbers from 1 to 16384.
    """
    match = re.fullmatch(r"(\d{1,6})[x×](\d{1,6})", text.strip().lower())
    if not match or not all(1 <= int(n) <= 16384 for n in match.groups()):
        raise UsageError(f"{what}: expected WxH with 1 to 16384 pixels a side, such as 512x512, got {text!r}")
    return int(match[1]), int(match[2])


def scene(args: argparse.Namespace):
    """The scene that is asked for, in the environment that is asked for.

    Raises:
        SceneError: there is no such scene, or its file or the environment's is wrong.
        UsageError: a rotation of nothing.
    """
    from dataclasses import replace

    from lightmeter.scenes.load import load

    found = load(args.scene, args.camera)
    if args.environment is None:
        if args.rotate or args.environment_clamp:
            raise UsageError("--rotate and --environment-clamp are of the map that --environment names")
        return found
    from lightmeter.scenes.environments import BUILT_IN, built_in, environment_from
    from lightmeter.scenes.framing import LIGHTS_NOTE

    notes: list[str] = []
    if args.environment in BUILT_IN:
        around = built_in(args.environment, degrees=args.rotate)
    else:
        around = environment_from(
            Path(args.environment), degrees=args.rotate, clamp=args.environment_clamp, note=notes.append
        )
    if LIGHTS_NOTE in found.notes:  # the map gives light, so that no rig is needed
        found = replace(found, lights=(), notes=tuple(note for note in found.notes if note != LIGHTS_NOTE))
    return replace(found, environment=around, notes=(*found.notes, *notes))


def budget(args: argparse.Namespace) -> Budget:
    """The truth's budget.

    Raises:
        UsageError: where both are given, or one is out of range.
    """
    if args.spp is not None and args.seconds is not None:
        raise UsageError("--spp and --seconds: give one of them")
    if args.spp is not None and not MIN_BATCHES <= args.spp <= MAX_SPP:
        raise UsageError(
            f"--spp: expected {MIN_BATCHES} to {MAX_SPP}, got {args.spp}; every interval needs {MIN_BATCHES} batches"
        )
    if args.seconds is not None and not 0 < args.seconds <= 1e6:
        raise UsageError(f"--seconds: expected a time above 0 and up to 1e6, got {args.seconds}")
    if not 0 <= args.seed < 1 << 32:
        raise UsageError(f"--seed: expected 0 to {(1 << 32) - 1}, got {args.seed}")
    if args.seconds is not None:
        return Budget(None, args.seconds)
    return Budget(args.spp or DEFAULT_SPP)


def words(args: argparse.Namespace) -> Words:
    """The choice of effects.

    Raises:
        UsageError: where a setting is not EFFECT.KNOB=VALUE, or two are of the same knob and differ.
    """
    settings: dict[str, dict[str, Any]] = {}
    for text in args.set:
        match = re.fullmatch(r"\s*([^.=\s]+)\.([^.=\s]+)\s*=\s*(.+?)\s*", text)
        if not match:
            raise UsageError(f"--set: expected EFFECT.KNOB=VALUE, such as shadow_map.resolution=2048, got {text!r}")
        effect, knob, value = match.groups()
        before = settings.setdefault(effect, {}).setdefault(knob, value)
        if before != value:
            raise UsageError(f"--set: {effect}.{knob} is set to {before} and to {value}; give one of them")
    return Words(tuple(args.only), tuple(args.without), tuple(args.use), settings)


def check_seconds(seconds: float | None, name: str = "--seconds") -> None:
    """Raises UsageError where a time budget is none; `name` is what the message calls it."""
    if seconds is not None and not 0 < seconds <= 1e6:
        raise UsageError(f"{name}: expected a time above 0 and up to 1e6, got {seconds:g}")


def check_confidence(confidence: float | None, name: str = "--confidence") -> None:
    """Raises UsageError where it is no confidence that a verdict could have; `name` is what the message calls it."""
    if confidence is not None and not 0.5 <= confidence < 1:
        raise UsageError(f"{name}: expected 0.5 or more and below 1, got {confidence:g}")


def output_folder(path: str | Path) -> Path:
    """The folder that results go to, made and tried before hours of work are spent on them.

    Raises:
        UsageError: it cannot be made or written to.
    """
    folder = Path(path)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        trial = folder / f".trial-{os.getpid()}"
        trial.touch()
        trial.unlink()
    except FileExistsError:
        raise UsageError(f"{folder}: expected a folder to write to, found a file; name another with -o") from None
    except OSError as error:
        raise UsageError(f"{folder}: cannot be written to ({error.strerror}); name another folder with -o") from None
    return folder


def say(message: str) -> None:
    """Tells the user something that is no result, on stderr."""
    print(f"lightmeter: {message}", file=sys.stderr)


def names(text: str) -> tuple[str, ...]:
    """The names in a list with commas, for `type=`."""
    found = tuple(name.strip() for name in text.split(",") if name.strip())
    if not found:  # an empty list of effects would mean all of them
        raise argparse.ArgumentTypeError(f"expected names with commas between them, got {text!r}")
    return found
