"""What `compare` leaves behind: report, results, heatmaps, layers; and what it prints."""

import sys
from pathlib import Path

import numpy as np

from lightmeter.comparison import Outcome
from lightmeter.measuring import clipped
from lightmeter.metrics.flip import ldr_flip
from lightmeter.report_folder import write_folder
from lightmeter.reports.display_curve import DisplayCurve
from lightmeter.reports.pictures import ErrorMap, Pair, flip_error, rms_error, signed_error
from lightmeter.reports.results import to_json
from lightmeter.sides import Sides

RADIANCE = "W/sr/m²"


def write_outcome(folder: Path, outcome: Outcome) -> Path:
    """Write everything; gives the report's path."""
    return write_folder(folder, outcome.results, pictures(outcome), display_curve(outcome))


def pictures(outcome: Outcome) -> list[Pair]:
    """The frame against the reference, then every effect against its oracle."""
    frame = Sides([outcome.frame.radiance], outcome.reference)
    unapproximated = tuple(
        share
        for player in (outcome.results.attribution.players if outcome.results.attribution else ())
        if not player.approximated
        for share in _share_maps(outcome, player.name, f" of {player.name}")
    )
    pairs = [_pair("frame", "Frame", (), frame, outcome, "The whole frame.", unapproximated)]
    for name, sides in outcome.sides.items():
        effect = outcome.plan.effects[name][0]
        pairs.append(_pair(name, name, effect.terms, sides, outcome, effect.summary, _share_maps(outcome, name)))
    return pairs


def _share_maps(outcome: Outcome, player: str, suffix: str = "") -> tuple[ErrorMap, ...]:
    """Where in the image a player's shares of the frame's error lie."""
    titles = {"flip": "Share of the frame's FLIP", "mse": "Share of the frame's squared error"}
    units = {"flip": "", "mse": f"({RADIANCE})²"}
    return tuple(
        ErrorMap(
            f"share_{metric}{suffix.replace(' of ', '_')}",
            titles[metric] + suffix,
            maps[player],
            units[metric],
            "signed",
        )
        for metric, maps in (outcome.shares.maps.items() if outcome.shares else ())
        if player in maps
    )


def _pair(
    name: str,
    title: str,
    terms: tuple[str, ...],
    sides: Sides,
    outcome: Outcome,
    caption: str,
    shares: tuple[ErrorMap, ...] = (),
) -> Pair:
    tested = np.mean(sides.tested, axis=0, dtype=np.float64).astype(np.float32)
    truth = np.mean(sides.truth, axis=0, dtype=np.float64).astype(np.float32)
    linear = sides.space == "scene-linear"
    unit = RADIANCE if linear else ""
    display = outcome.display if linear else clipped
    errors = (
        flip_error(ldr_flip(display(tested), display(truth))),
        rms_error(tested, truth, unit),
        signed_error(tested, truth, unit),
        *shares,
    )
    space = "scene-linear" if linear else "display"
    return Pair(name, title, terms, tested, truth, errors, space=space, unit=unit, caption=caption)


def display_curve(outcome: Outcome) -> DisplayCurve:
    """The display transform of grey: log2 of radiance to code value 0…1."""
    stops = np.linspace(-16.0, 16.0, 513)
    grey = np.repeat((2.0**stops)[:, None], 3, axis=1)
    used = [name for term in ("tone", "encode") if (name := outcome.plan.effect_of(term))]
    return DisplayCurve(tuple(stops), tuple(outcome.display(grey)[:, 0]), " + ".join(used) or "clipped")


def print_outcome(outcome: Outcome, report: Path, json: bool) -> None:
    """The table, or results.json itself, on stdout; where the report is on stderr or at the end."""
    if json:
        sys.stdout.write(to_json(outcome.results))
        print(f"report: {report}", file=sys.stderr)
        return
    from lightmeter.reports.terminal import comparison
    from lightmeter.terminal import console

    console().print(comparison(outcome.results))
    print(f"report: {report}")
