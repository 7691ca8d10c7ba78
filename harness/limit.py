"""A limit on one number of a scene's frame, of an effect or of a candidate."""

from dataclasses import dataclass

from lightmeter.conditions import Conditions
from lightmeter.regions import EVERYWHERE, Region

FRAME = "frame"
TIME_RATIO, TIME_MS = "time_ratio", "time_ms"
TIMES = (TIME_RATIO, TIME_MS)
"""What can be limited beside the metrics of images."""

MASKED = "masked"
"""The fraction of pixels that a candidate is not judged on, 0…1."""


@dataclass(frozen=True)
class Limit:
    """A bound on one number.

    Attributes:
        place: where it is written, for messages.
        scene: the pattern or name as it is written.
        of: "frame", or an effect's name; of a candidate, one of its layers.
        metric: of the registry, or "time_ratio", "time_ms" or "masked".
        high, low, regression: the bound; exactly one of them is given. A regression is a fraction of the baseline.
        variant: what sets its conditions apart from `[defaults]`, in words.
        to: of a time ratio, what the time is divided by: "frame", or an effect's name.
        device: of a time, the digest of the device that it was written for.
        region: which pixels count.
        candidate: whose frame it is on; None: ours.
    """

    place: str
    scene: str
    of: str
    metric: str
    high: float | None
    low: float | None
    conditions: Conditions
    variant: str = ""
    regression: float | None = None
    to: str | None = None
    device: str | None = None
    region: Region = EVERYWHERE
    candidate: str | None = None

    @property
    def words(self) -> str:
        """ "flip <= 0.12", "time_ratio to frame <= 0.3", "rmse <= baseline + 2 % on object ball"."""
        what = f"{self.metric} to {self.to}" if self.to else self.metric
        if self.regression is not None:
            bound = f"at most {100 * self.regression:g} % worse than the baseline"
        else:
            bound = f"<= {self.high:g}" if self.high is not None else f">= {self.low:g}"
        return " ".join(part for part in (what, bound, self.region.words) if part)

    @property
    def what(self) -> str:
        """What it is on: "frame", "shadow_map", "our engine", "our engine visibility.0"."""
        if self.candidate is None:
            return self.of
        return self.candidate if self.of == FRAME else f"{self.candidate} {self.of}"

    @property
    def is_time(self) -> bool:
        """Whether it is on a time, not on an image."""
        return self.metric in TIMES
