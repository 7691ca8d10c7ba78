"""A limit on a scene while it is undecided, and what is said of it once it is."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from lightmeter.baseline import Baseline, regression_bound
from lightmeter.cases import Case
from lightmeter.device import device_digest
from lightmeter.failures import UsageError
from lightmeter.hints import nearest
from lightmeter.limit import Limit
from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.registry import find_metric
from lightmeter.metrics.sequential import Bound, Look, error_per_look
from lightmeter.planning import this_device
from lightmeter.reports.verdict import Status, Verdict
from lightmeter.sides import Sides
from lightmeter.verdict import bound_of, explain_verdict


@dataclass(eq=False)
class Trial:
    """One limit on one scene, until it is decided.

    Attributes:
        bound: None while a baseline is made: then the interval only has to be narrow.
        alpha: what one look may spend.
        rule: what is to be said of the bound ("" or the tolerance on another device).
        last: what the last look found.
        sides: the images it was on, their means alone; None for a time.
    """

    limit: Limit
    case: Case
    bound: Bound | None
    alpha: float
    rule: str = ""
    verdict: Verdict | None = None
    last: Look | None = None
    looks: int = 0
    sides: Sides | None = None

    @property
    def name(self) -> str:
        """ "posts/shadow_map/rmse", with the region; what a baseline knows it by, too."""
        words = self.limit.region.words
        metric = f"{self.limit.metric} to {self.limit.to}" if self.limit.to else self.limit.metric
        return f"{self.case.name}/{self.limit.what}/{metric}" + (f" {words}" if words else "")

    def unseen(self) -> Verdict:
        """What can be said of a limit whose image is not there: undecided."""
        limit = self.limit
        return Verdict(
            name=self.name,
            status="UNDECIDED",
            measurement=None,
            limit=limit.words,
            scene=self.case.name,
            of=limit.what,
            metric=limit.metric,
            high=limit.high,
            low=limit.low,
            regression=limit.regression,
        )

    def unmeasured(self, reason: str = "") -> Verdict:
        """The same of one whose image is there and has not been measured, with the reason where there is one."""
        limit = self.limit
        pixels = None if limit.is_time else self.case.pixels(limit)
        message = f"{limit.metric} of {limit.what}: {reason}" if reason else ""
        return replace(self.unseen(), pixels=pixels, message=message, reason=reason)

    def judged(self, status: Status, measurement: Measurement, samples: int, looks: int) -> Verdict:
        """The verdict on a measurement.

        Args:
            samples: what it rests on.
            looks: how many were planned; the error is spent in equal parts on them.
        """
        message = explain_verdict(self.limit, measurement, status)
        if self.bound is not None and self.limit.regression is not None:
            message += f" (PASS up to {self.bound.safe:.5g}, FAIL from {self.bound.lost:.5g})"
        if self.rule:
            message += f"; {self.rule}"
        return replace(
            self.unmeasured(),
            status=status,
            measurement=measurement,
            message=message,
            samples=samples,
            looks=self.looks,
            error=self.looks * self.alpha / looks,
        )


def start_trials(
    pairs: Sequence[tuple[Limit, Case]], confidence: float, baseline: Baseline | None = None
) -> list[Trial]:
    """The trials of these limits, the allowed error divided among them.

    Raises:
        UsageError: a regression has no stored value, or a region no pixel.
    """
    trials = []
    for limit, case in pairs:
        if not limit.is_time:
            case.region(limit)  # an empty region is said before time is spent
        trial = Trial(limit, case, None, error_per_look(confidence, len(pairs), 1))
        if limit.regression is None:
            trial.bound = bound_of(limit)
        elif baseline is not None:
            trial.bound, trial.rule = _baseline_bound(trial, baseline)
        if limit.regression is not None:
            trial.alpha /= 2  # the other half is the baseline's
        trials.append(trial)
    return trials


def _baseline_bound(trial: Trial, baseline: Baseline) -> tuple[Bound, str]:
    limit = trial.limit
    stored = baseline.values.get(trial.name)
    if stored is None:
        known = f"; {nearest(trial.name, baseline.values)}" if baseline.values else ""
        raise UsageError(
            f"{limit.place}: the baseline has no value for {trial.name!r}{known}; write it with `lightmeter gate "
            "--update`"
        )
    device = this_device()
    more, rule = baseline.tolerance(stored, device_digest(device), device)
    metric = find_metric(limit.metric)
    assert limit.regression is not None
    return regression_bound(stored, limit.regression + more, metric.larger_is_worse, metric.signed), rule
