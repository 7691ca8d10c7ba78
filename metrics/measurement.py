"""A measured value with its interval, its unit and how it was obtained."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Measurement:
    """One number and how sure it is.

    Attributes:
        value: the estimate, in `unit`.
        low: lower end of the interval at the comparison's confidence; None where no interval can be had.
        high: upper end of that interval; None where no interval can be had.
        unit: the unit as it is printed ("W/sr/m²", "dB", "" for a pure number).
        how: the estimator in a few words ("U-statistic over 8 batches, jackknife, Student t").
        floor: the same metric between two halves of the reference, for metrics that noise biases;
            None where noise does not bias the metric.
        corrected: the value extrapolated to no noise, for metrics that noise biases; else None.
    """

    value: float
    low: float | None = None
    high: float | None = None
    unit: str = ""
    how: str = ""
    floor: float | None = None
    corrected: float | None = None
