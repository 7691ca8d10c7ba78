"""What a stress run found: plain numbers that reports and gates read."""

from dataclasses import dataclass, field

FORMATS = {
    "fp32": "a float32 target: the function's own arithmetic",
    "fp16": "the float32 result written to a half-float target (RGBA16F)",
    "r11g11b10f": "the float32 result written to an R11F_G11F_B10F target; not for results that may be negative",
    "mediump": "inputs and every operation rounded to half floats, as a mobile GPU may do it; attainable is what "
    "half-float inputs leave. The error is against the exact result of the unrounded inputs",
}
FAULTS = ("NaN", "inf", "negative")


@dataclass(frozen=True)
class Example:
    """One input and what came of it.

    Attributes:
        inputs: argument to its components, exact float32 values.
        got, exact: the function's results (out arguments behind the result), and float64's of the same inputs.
        relative, absolute: the error; relative is over the result's largest component.
        digits: −log₁₀ of the relative error, 0 to 7.2.
        attainable: the digits that half a rounding of the inputs leaves of the exact result: what is lost beyond
            is the arithmetic's own.
    """

    inputs: dict[str, list[float]]
    got: list[float]
    exact: list[float]
    relative: float
    absolute: float
    digits: float
    attainable: float = 7.2


@dataclass
class Cell:
    """A function in a regime and a format.

    Attributes:
        lanes: how many inputs were judged.
        counts: how many of them gave each fault.
        worst: the finite result with the largest relative error; None where none was finite.
        faults: the first input for each fault.
    """

    lanes: int = 0
    counts: dict[str, int] = field(default_factory=lambda: dict.fromkeys(FAULTS, 0))
    worst: Example | None = None
    faults: dict[str, Example] = field(default_factory=dict)

    @property
    def fault(self) -> str:
        """The gravest fault's name; "" where there is none."""
        return next((name for name in FAULTS if self.counts[name]), "")

    @property
    def digits(self) -> float:
        """Digits kept: none where something is not finite."""
        if self.counts["NaN"] or self.counts["inf"]:
            return 0.0
        return self.worst.digits if self.worst else 7.2

    @property
    def example(self) -> Example | None:
        """The input to look at."""
        return self.faults.get(self.fault) or self.worst


@dataclass(frozen=True)
class Stressed:
    """A function's findings.

    Attributes:
        name: OWNER/FUNCTION, "#2" behind the second declaration of the same.
        cells: format to regime to what was found.
        safe: the domain in which 1 % is kept, as (argument, from): α at cosines of at least 1e-3, and the least
            cosine at α of at least 1e-3; from is the smallest value tested where it is kept everywhere.
        largest: the largest relative and absolute error within the declared domain, in float32.
    """

    name: str
    file: str
    cells: dict[str, dict[str, Cell]]
    safe: dict[str, float | None]
    largest: dict[str, Example]
