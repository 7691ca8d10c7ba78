"""Tone curves against the reference display transform, on greys and on saturated colours.

    python benchmarks/tone_curves.py [--output TABLE.md]

Writes the table of docs/tone.md.
"""

import argparse
from pathlib import Path
from typing import Any

import numpy as np
from judged import publish

from lightmeter.groundtruth.oracles import encode, tone
from lightmeter.realtime.discovery import effect
from lightmeter.realtime.display import twin_of
from lightmeter.scenes.optics.color import LUMINANCE

CURVES: tuple[tuple[str, dict[str, Any]], ...] = (
    ("narkowicz", {}),
    ("narkowicz", {"prescale": 0.6}),
    ("narkowicz", {"prescale": 1.0}),
    ("hill", {}),
    ("hill", {"prescale": 1.67}),
    ("reinhard", {}),
    ("reinhard", {"on": "channels"}),
    ("reinhard", {"white": 1e6}),
)
STOPS = np.linspace(-8.0, 6.0, 281)
"""Luminances: a fifth of a thousandth, to sixty-four times white."""


def greys() -> np.ndarray:
    """(1, n, 3)."""
    return np.repeat(2.0 ** STOPS[None, :, None], 3, axis=2)


def colours(hues: int = 200) -> np.ndarray:
    """(hues, n, 3): random mixtures of the primaries, most of them saturated, at every luminance."""
    mixed = np.random.default_rng(0).dirichlet([0.6] * 3, (hues, 1))
    return mixed / (mixed @ LUMINANCE)[..., None] * 2.0 ** STOPS[None, :, None]


def row(name: str, knobs: dict[str, Any], view: str) -> str:
    """A curve's errors."""
    settings = effect(name).settings(knobs)

    def errors(image: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        ours, exact = twin_of(name, "tone")(image, settings), tone.evaluate(image, view)
        return ours - exact, encode.evaluate(ours) - encode.evaluate(exact)

    grey, colour = errors(greys()), errors(colours())
    rms = [float(np.sqrt(np.mean(np.square(codes)))) for codes in (grey[1], colour[1])]
    words = ", ".join(f"{knob} {value}" for knob, value in knobs.items())
    label = f"`{name}`" + (f", {words}" if words else "")
    return f"| {label} | {np.abs(grey[0]).max():.4f} | {rms[0]:.4f} | {rms[1]:.4f} | {np.abs(colour[1]).max():.2f} |"


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--output", type=Path, metavar="FILE", help="write the table here")
    args = parser.parse_args()
    head = "| curve | greys: largest, linear | RMS of codes | colours: RMS of codes | largest |"
    rule = "| --- | ---: | ---: | ---: | ---: |"
    tables = (["", f"{view}:", "", head, rule, *(row(*curve, view) for curve in CURVES)] for view in tone.VIEWS)
    publish(("\n".join(lines) for lines in tables), args.output)


if __name__ == "__main__":
    main()
