"""What `compare` leaves behind: report, results, heatmaps, layers; and what it prints."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

from lightmeter.comparison import Outcome
from lightmeter.display_chain import Chained, display_steps
from lightmeter.measuring import Display, clipped
from lightmeter.metrics.flip import ldr_flip
from lightmeter.realtime.display import POINTWISE
from lightmeter.report_folder import write_folder
from lightmeter.reports.display_curve import DisplayCurve
from lightmeter.reports.pictures import ErrorMap, Pair, flip_error, rms_error, share_map, signed_error
from lightmeter.reports.results_json import to_json
from lightmeter.scenes.terms import TERMS
from lightmeter.sides import Sides

RADIANCE = "W/sr/m²"


def write_outcome(folder: Path, outcome: Outcome) -> Path:
    """Write everything; gives the report's path."""
    return write_folder(folder, outcome.results, pictures(outcome), display_curve(outcome))


def pictures(outcome: Outcome) -> list[Pair]:
    """The frame against the reference, then every effect against its oracle."""
    whole = Sides([outcome.frame.radiance], outcome.reference)
    pairs = [_pair("frame", (), whole, outcome, "The whole frame.", "Frame"), *_screen(outcome)]
    for name, sides in outcome.sides.items():
        effect = outcome.plan.effects[name][0]
        pairs.append(_pair(name, effect.terms, sides, outcome, effect.summary))
    for name, sides in outcome.lacking.items():
        meaning = f"Not approximated: everything else is exact. {TERMS[name].meaning.capitalize()}."
        pairs.append(_pair(name, (name,), sides, outcome, meaning))
    for one in outcome.others.exhibits:
        pair = _pair(one.name, one.terms, one.sides, outcome, one.caption, display=one.display)
        pairs.append(replace(pair, mask=one.mask, labels=(one.engine, "truth")))
    return pairs


def _screen(outcome: Outcome) -> list[Pair]:
    """What the screen shows, where that is more than the frame seen through a curve: with glare, metered."""
    spatial = [step for step in display_steps(outcome.plan) if step.writes[0] not in POINTWISE]
    shown = outcome.frame.display
    if not spatial or shown is None:
        return []
    chain = Chained(outcome.plan, np.mean(outcome.reference, axis=0, dtype=np.float64))
    exact = chain.whole({step.effect for step in display_steps(outcome.plan)})
    sides = Sides([(shown / 255).astype(np.float32)], [exact], "display")
    return [
        _pair("screen", (), sides, outcome, "What the screen shows: the whole display chain on both sides.", "Screen")
    ]


def _share_maps(outcome: Outcome, player: str) -> tuple[ErrorMap, ...]:
    """Where in the image a player's shares of the frame's error lie."""
    units = {"flip": "", "mse": f"({RADIANCE})²"}
    shares = outcome.shares.maps if outcome.shares else {}
    return tuple(share_map(metric, maps[player], units[metric]) for metric, maps in shares.items() if player in maps)


def _pair(
    name: str,
    terms: tuple[str, ...],
    sides: Sides,
    outcome: Outcome,
    caption: str,
    title: str | None = None,
    display: Display | None = None,
) -> Pair:
    tested = np.mean(sides.tested, axis=0, dtype=np.float64).astype(np.float32)
    truth = np.mean(sides.truth, axis=0, dtype=np.float64).astype(np.float32)
    linear = sides.space == "scene-linear"
    unit = RADIANCE if linear else ""
    display = display or (outcome.display if linear else clipped)
    errors = (
        flip_error(ldr_flip(display(tested), display(truth))),
        rms_error(tested, truth, unit),
        signed_error(tested, truth, unit),
        *_share_maps(outcome, name),
    )
    space = "scene-linear" if linear else "display"
    return Pair(name, title or name, terms, tested, truth, errors, space=space, unit=unit, caption=caption)


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
