"""What a gate says of one limit."""

from dataclasses import dataclass
from typing import Literal

from lightmeter.metrics.measurement import Measurement

Status = Literal["PASS", "FAIL", "UNDECIDED"]


@dataclass(frozen=True)
class Verdict:
    """Whether one limit holds.

    Attributes:
        name: what was judged, "scene/effect/metric"; the part before the last "/" groups cases.
        status: "PASS", "FAIL" or "UNDECIDED".
        measurement: the value with the interval that was judged; None where it could not be measured.
        limit: the limit as it is written ("rmse <= 0.02"), or its number.
        message: one sentence for people.
        seconds: how long it took to judge.
        scene: the scene with what sets its conditions apart.
        of: "frame", or an effect's name.
        metric: its name.
        high, low, regression: the bound as it is written; None where it is another one.
        samples: per pixel, that the verdict took; frames for a time.
        looks: how often the numbers were looked at.
        error: the chance of a wrong verdict that these looks may have spent.
        pixels: how many counted; None for a time.
        reason: why it is undecided; "" where it is not.
    """

    name: str
    status: Status
    measurement: Measurement | None
    limit: float | str
    message: str = ""
    seconds: float = 0.0
    scene: str = ""
    of: str = ""
    metric: str = ""
    high: float | None = None
    low: float | None = None
    regression: float | None = None
    samples: int = 0
    looks: int = 0
    error: float = 0.0
    pixels: int | None = None
    reason: str = ""
