"""The laws of reflection in a stress run: a table for the terminal, rows for the page, a line for each violation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from lightmeter.realtime.stress.both_sides import Extreme
from lightmeter.realtime.stress.laws import ALBEDO, RECIPROCITY, Laws
from lightmeter.reports.stress_results import words

if TYPE_CHECKING:
    from rich.table import Table

HEADINGS = ("function", "one-sided", "device", "albedo", "±", "device", "of")
MEANING = (
    "One-sided: |f(v, l) − f(l, v)| over the larger, cosines from 0.001 (~: of the inputs' own rounding). Albedo: the "
    "largest, of light from everywhere, n·v from 0.01; ± is the quadrature's error and the function's roundings. Each "
    "first by the model, the float64 twin."
)
CAUSES = {
    "model": "by its definition",
    "device": "by its arithmetic: float64 is not",
    "inputs": "by the rounding of its directions' lengths",
}


@dataclass(frozen=True)
class Violation:
    """A law that a function does not keep, in words, and the command that shows it."""

    function: str
    what: str
    command: str


def law_command(name: str, law: str, extreme: Extreme) -> str:
    """The command line that holds a law of a function at an input again."""
    return f"lightmeter stress --function '{name}' --law {law} --input {words(extreme.inputs)}"


def violations(name: str, laws: Laws) -> list[Violation]:
    """What is not kept; what the inputs' rounding alone does is no violation."""
    found = []
    if laws.one_sided in ("model", "device"):
        worst = laws.reciprocity[laws.one_sided]
        what = f"not reciprocal, {CAUSES[laws.one_sided]}: off by {share(getattr(worst, laws.one_sided))}"
        found.append(Violation(name, what, law_command(name, RECIPROCITY, worst)))
    if laws.gains and laws.albedo:
        value = getattr(laws.albedo, laws.gains)
        what = f"makes energy, {CAUSES[laws.gains]}: albedo {value:.5g} ± {laws.albedo.error:.0e}"
        found.append(Violation(name, what, law_command(name, ALBEDO, laws.albedo)))
    return found


def rows(laws: Mapping[str, Laws]) -> list[list[str]]:
    """Text under `HEADINGS`, a row for each function."""
    found = []
    for name, held in laws.items():
        model, device = held.reciprocity["model"].model, held.reciprocity["device"].device
        rounded = "~" if held.one_sided == "inputs" else ""
        albedo = held.albedo
        cells = ["", "", "", ""]
        if albedo:
            cells = [f"{albedo.model:.5f}", f"{albedo.error:.0e}", f"{albedo.device:.5f}", surface(albedo)]
        found.append([name, share(model), rounded + share(device), *cells])
    return found


def law_table(laws: Mapping[str, Laws]) -> Table:
    """One row for each function that declares itself a BRDF, or a factor of one."""
    from rich.table import Table
    from rich.text import Text

    table = Table(title="Laws of reflection", title_justify="left", box=None, padding=(0, 1, 0, 0), caption=MEANING)
    table.caption_justify = "left"
    for heading in HEADINGS:
        left = heading in ("function", "of")
        table.add_column(heading, no_wrap=heading == "function", justify="left" if left else "right")
    for row, held in zip(rows(laws), laws.values(), strict=True):
        one_sided = "bold red" if held.one_sided in ("model", "device") else ""
        gains = "bold red" if held.gains else ""
        styles = ["", one_sided, one_sided, gains, "", gains, "dim"]
        table.add_row(*(Text(text, style=style) for text, style in zip(row, styles, strict=True)))
    return table


def share(value: float) -> str:
    """A relative violation: "0" where float64's own rounding makes as much."""
    return "0" if value < 1e-9 else f"{value:.0e}" if value < 1e-3 else f"{value:.3f}"


def surface(extreme: Extreme) -> str:
    """What an albedo is of, in few digits; a grey as one number."""
    parts = []
    for name, values in extreme.inputs.items():
        shown = [f"{v:.3g}" for v in values]
        parts.append(f"{name}={shown[0] if len(set(shown)) == 1 else ','.join(shown)}")
    return " ".join(parts)


def at_input(law: str, extreme: Extreme) -> str:
    """One input in words."""
    if law == RECIPROCITY:
        return (
            f"|f(v, l) − f(l, v)| over the larger: {extreme.model:.3g} by the model, {extreme.given:.3g} in float64 of "
            f"these inputs, {extreme.device:.3g} on the device"
        )
    return f"albedo: {extreme.model:.7g} by the model, {extreme.device:.7g} on the device, ± {extreme.error:.1e}"
