"""Holds limits: draws more of what is undecided, the cheapest first, until all is decided or the budget ends."""

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from lightmeter.baseline import Baseline, regression_bound
from lightmeter.candidates.failure import CandidateError
from lightmeter.candidates.subject import CandidateSubject
from lightmeter.cases import Case
from lightmeter.device import device_digest
from lightmeter.failures import UsageError
from lightmeter.hints import nearest
from lightmeter.limits import FRAME, MASKED, TIME_MS, Limit
from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.registry import find_metric
from lightmeter.metrics.sequential import LEAST_COUNT, Bound, Look, error_per_look, look
from lightmeter.planning import this_device
from lightmeter.progress import Report, silent
from lightmeter.realtime.graph import DISPLAY_TERMS
from lightmeter.reports.verdict import Verdict
from lightmeter.sides import Sides
from lightmeter.subjects import EffectSubject, FrameSubject, ImageSubject, Subject, TimeSubject
from lightmeter.verdict import STATUS, bound_of, explain_verdict
from lightmeter.verdict import judge as judge_point

PRECISE = 0.25
"""A baseline is precise enough when its interval's half is no more than this part of the regression it serves."""


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


@dataclass(eq=False)
class Work:
    """A subject with the trials on it, and the time it has taken."""

    subject: Subject
    trials: list[Trial]
    spent: float = 0.0
    next_look: int = 0

    @property
    def open(self) -> list[Trial]:
        """What is still undecided."""
        return [trial for trial in self.trials if trial.verdict is None]


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


def decide(
    trials: Sequence[Trial],
    seconds: float | None = None,
    report: Report = silent,
    clock: Callable[[], float] = time.perf_counter,
) -> list[Verdict]:
    """The verdicts, in the order of the trials. Always works on the undecided subject that has taken least time.

    Args:
        seconds: for all of them together; None: until the samples are spent.
    """
    end = math.inf if seconds is None else clock() + seconds
    for trial in trials:
        if trial.limit.candidate is not None:
            see_candidate(trial)
    works = _works(trials)
    for work in works:
        for trial in work.trials:
            _refuse_device(trial)
    while waiting := [work for work in works if work.open]:
        report("verdicts", sum(t.verdict is not None for t in trials), len(trials))
        work = min(waiting, key=lambda w: w.spent)
        start = clock()
        _step(work, lambda: clock() < end)
        work.spent += clock() - start
        if work.next_look == len(work.subject.looks):
            _give_up(work, None)
        _stamp(work)
        if clock() >= end:
            break
    for work in works:
        _give_up(work, seconds)
        _stamp(work)
    report("verdicts", len(trials), len(trials))
    return [trial.verdict for trial in trials if trial.verdict is not None]


def _give_up(work: Work, seconds: float | None) -> None:
    """Leave what is open undecided; `seconds`: the time budget, where that has ended."""
    for trial in work.open:
        trial.verdict = _undecided(trial, work, seconds)


def _stamp(work: Work) -> None:
    """Note what new verdicts took; once all are there, keep the pictures' means and let the batches go."""
    for trial in work.trials:
        if trial.verdict is not None and trial.verdict.seconds == 0:
            trial.verdict = replace(trial.verdict, seconds=work.spent)
    if not work.open and isinstance(work.subject, ImageSubject) and work.subject.groups.images:
        for trial in work.trials:
            trial.sides = work.subject.means(trial.limit)
        work.subject.groups.images.clear()


def _works(trials: Sequence[Trial]) -> list[Work]:
    """A subject for each thing that limits are on; the frame's and the display effects' share the reference."""
    works: dict[tuple[Case, str], Work] = {}
    for trial in trials:
        case, limit, of = trial.case, trial.limit, trial.limit.of
        if (name := limit.candidate) is not None:
            kind, make = limit.what, lambda case=case, name=name, of=of: CandidateSubject(case, name, of)
        elif limit.is_time:
            kind, make = "times", lambda case=case: TimeSubject(case)
        elif of == FRAME or set(case.plan.effects[of][0].terms) & set(DISPLAY_TERMS):
            kind, make = FRAME, lambda case=case: FrameSubject(case)
        else:
            kind, make = f"effect {of}", lambda case=case, of=of: EffectSubject(case, of)
        if (case, kind) not in works:
            works[case, kind] = Work(make(), [])
        works[case, kind].trials.append(trial)
    return list(works.values())


def _step(work: Work, go_on: Callable[[], bool]) -> None:
    """Draw up to the next look, and look at every open trial."""
    subject = work.subject
    _refuse_broken(work)
    _refuse_doubtful(work)
    if not work.open or not subject.advance(subject.looks[work.next_look], go_on):
        return
    _refuse_broken(work)
    for trial in work.open:
        alpha = trial.alpha / len(subject.looks)
        bound = trial.bound or Bound(math.inf, math.inf)
        limit = trial.limit
        found = look(bound, alpha, lambda c, of=limit: subject.measure(of, c), lambda of=limit: subject.count(of))
        trial.looks += 1
        trial.last = found
        if math.isnan(found.measurement.value):
            trial.verdict = _verdict(trial, work, "FAIL", found.measurement)
        elif trial.bound is None:
            if found.side == "within" and _precise(trial.limit, found.measurement):
                trial.verdict = _verdict(trial, work, "PASS", found.measurement)
        elif found.side != "open":
            trial.verdict = _verdict(trial, work, STATUS[found.side], found.measurement)
    work.next_look += 1


def _precise(limit: Limit, measurement: Measurement) -> bool:
    assert limit.regression is not None
    half = ((measurement.high or 0.0) - (measurement.low or 0.0)) / 2
    return half <= PRECISE * limit.regression * abs(measurement.value)


def _refuse_broken(work: Work) -> None:
    """What is not finite fails at once."""
    for trial in work.open:
        bad = work.subject.broken(trial.limit)
        if bad:
            trial.verdict = _verdict(trial, work, "FAIL", Measurement(math.nan, how=f"failed: {bad}"))


def _refuse_doubtful(work: Work) -> None:
    """On a truth that fails its own checks nothing is decided."""
    if not work.open or not (reason := work.subject.doubt()):
        return
    for trial in work.open:
        message = f"{trial.limit.metric} of {trial.limit.what}: {reason}"
        trial.verdict = replace(_bare(trial), message=message, reason=reason)


def see_candidate(trial: Trial) -> None:
    """Obtain and register a candidate's frame. Where it gave none that the limit can be on, the limit fails."""
    limit, case = trial.limit, trial.case
    try:
        judged = case.judged(limit.candidate or "")
        judged.check(limit.of, limit.metric)
    except CandidateError as error:
        why = f"{limit.what} of {case.name} cannot be judged: {error}"
        failed = Measurement(math.nan, how="failed")
        trial.verdict = replace(_named(trial), status="FAIL", measurement=failed, message=why)
        return
    trial.rule = "; ".join(filter(None, (trial.rule, judged.words)))
    if limit.metric == MASKED:
        found = Measurement(judged.masked_fraction, how="counted")
        status = judge_point(bound_of(limit), found)
        message = explain_verdict(limit, found, status)
        trial.verdict = replace(_bare(trial), status=status, measurement=found, message=message)


def _refuse_device(trial: Trial) -> None:
    """A time in milliseconds says nothing on another device."""
    limit = trial.limit
    if limit.metric != TIME_MS:
        return
    here = device_digest(this_device())
    if limit.device != here:
        reason = f"not judged: the limit was written for device {limit.device}, and this is {here}"
        trial.verdict = replace(_bare(trial), message=f"time_ms of {limit.what}: {reason}", reason=reason)


def _named(trial: Trial) -> Verdict:
    """What can be said of a limit whose image is not there."""
    limit, case = trial.limit, trial.case
    return Verdict(
        name=trial.name,
        status="UNDECIDED",
        measurement=None,
        limit=limit.words,
        scene=case.name,
        of=limit.what,
        metric=limit.metric,
        high=limit.high,
        low=limit.low,
        regression=limit.regression,
    )


def _bare(trial: Trial) -> Verdict:
    return replace(_named(trial), pixels=None if trial.limit.is_time else trial.case.pixels(trial.limit))


def _verdict(trial: Trial, work: Work, status, measurement: Measurement) -> Verdict:
    message = explain_verdict(trial.limit, measurement, status)
    if trial.bound is not None and trial.limit.regression is not None:
        message += f" (PASS up to {trial.bound.safe:.5g}, FAIL from {trial.bound.lost:.5g})"
    if trial.rule:
        message += f"; {trial.rule}"
    return replace(
        _bare(trial),
        status=status,
        measurement=measurement,
        message=message,
        samples=work.subject.samples,
        looks=trial.looks,
        error=trial.looks * trial.alpha / len(work.subject.looks),
    )


def _undecided(trial: Trial, work: Work, seconds: float | None) -> Verdict:
    """Why a trial is left open."""
    found = trial.last
    if found is None:
        reason = f"the time budget of {seconds:g} s ended before the first look; give more with --seconds"
        return replace(_bare(trial), message=f"{trial.limit.metric} of {trial.limit.what}: {reason}", reason=reason)
    count = work.subject.count(trial.limit)
    if count < LEAST_COUNT:
        reason = (
            f"heavy tails: as few as {count:.0f} samples carry the spread, so that no interval can be trusted; "
            "more samples may help, or a region without the fireflies"
        )
    elif found.measurement.low is None:
        reason = f"no interval: {found.measurement.how}"
    elif seconds is not None:
        reason = f"the time budget of {seconds:g} s ended; give more with --seconds"
    else:
        reason = f"the budget of {work.subject.samples} samples ended; a larger spp narrows the interval"
    verdict = _verdict(trial, work, "UNDECIDED", found.measurement)
    return replace(verdict, message=f"{verdict.message}: {reason}", reason=reason)
