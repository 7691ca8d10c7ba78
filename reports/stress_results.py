"""The results of a stress run, as `stress.json` holds them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from lightmeter.realtime.stress.findings import Cell, Example, Stressed
from lightmeter.realtime.stress.laws import Laws

SCHEMA = 2
SHORT = {
    "ordinary": "ord",
    **{f"α ≥ {10.0**-e:g}": f"α-{e}" for e in range(1, 7)},
    "grazing": "grz",
    "head-on": "hd",
    "cosine ≤ 0": "c≤0",
    "cosine > 1": "c>1",
    "opposite": "opp",
    "not unit": "len",
    "zero vector": "0v",
    "black or white": "b/w",
    "beyond 0…1": ">1",
    "index near 1": "n≈1",
    "index below 1": "n<1",
    "tiny": "tny",
    "huge": "hug",
    "denormal": "den",
}
"""Regimes as a terminal's columns call them."""

WELL_KEPT = 5.0
"""Digits from which up nothing is said of a loss."""
OWN_LOSS = 1.0
"""Digits lost beyond what the inputs' rounding takes, from which on a loss is called the arithmetic's own."""


@dataclass(frozen=True)
class StressResults:
    """Everything a run found.

    Attributes:
        schema: counts up when keys change.
        seed: of designed and searched inputs.
        device: what ran it.
        functions: in the order of their declaration.
        laws: of those functions that are BRDFs or factors of one, by name.
    """

    schema: int
    seed: int
    device: dict[str, Any]
    functions: Sequence[Stressed]
    laws: Mapping[str, Laws] = field(default_factory=dict)


def command(name: str, example: Example) -> str:
    """The command line that evaluates a function at an input again."""
    return f"lightmeter stress --function '{name}' --input {words(example.inputs)}"


def words(inputs: Mapping[str, Sequence[float]]) -> str:
    """An input as the command line takes it, exactly."""
    return " ".join(f"{argument}={','.join(f'{v:.9g}' for v in values)}" for argument, values in inputs.items())


def inherent(cell: Cell) -> bool:
    """Whether the loss lies in the inputs: moving them by half a rounding changes the exact result as much."""
    example = cell.example
    if cell.fault or example is None or cell.digits >= WELL_KEPT:
        return False
    return example.digits > example.attainable - OWN_LOSS


def shown(cell: Cell) -> str:
    """A cell in three characters: its gravest fault, else the digits kept."""
    return {"NaN": "NaN", "inf": "inf", "negative": "neg"}.get(cell.fault, f"{cell.digits:.1f}")
