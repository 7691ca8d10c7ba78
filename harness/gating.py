"""Holds limits: draws more of what is undecided, the cheapest first, until all is decided or the budget ends."""

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from lightmeter.candidates.failure import CandidateError
from lightmeter.candidates.subject import CandidateSubject
from lightmeter.cases import Case
from lightmeter.device import device_digest
from lightmeter.limit import FRAME, MASKED, TIME_MS, Limit
from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.sequential import LEAST_COUNT, Bound, look
from lightmeter.planning import this_device
from lightmeter.progress import Report, silent
from lightmeter.realtime.graph import DISPLAY_TERMS
from lightmeter.reports.verdict import Status, Verdict
from lightmeter.subjects import EffectSubject, FrameSubject, ImageSubject, Subject, TimeSubject
from lightmeter.trials import Trial
from lightmeter.verdict import STATUS, bound_of, explain_verdict
from lightmeter.verdict import judge as judge_point

PRECISE = 0.25
"""A baseline is precise enough when its interval's half is no more than this part of the regression it serves."""


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
        trial.verdict = trial.unmeasured(reason)


def see_candidate(trial: Trial) -> None:
    """Obtain and register a candidate's frame. Where it gave none that the limit can be on, the limit fails."""
    limit, case = trial.limit, trial.case
    try:
        judged = case.judged(limit.candidate or "")
        judged.check(limit.of, limit.metric)
    except CandidateError as error:
        why = f"{limit.what} of {case.name} cannot be judged: {error}"
        failed = Measurement(math.nan, how="failed")
        trial.verdict = replace(trial.unseen(), status="FAIL", measurement=failed, message=why)
        return
    trial.rule = "; ".join(filter(None, (trial.rule, judged.words)))
    if limit.metric == MASKED:
        found = Measurement(judged.masked_fraction, how="counted")
        status = judge_point(bound_of(limit), found)
        message = explain_verdict(limit, found, status)
        trial.verdict = replace(trial.unmeasured(), status=status, measurement=found, message=message)


def _refuse_device(trial: Trial) -> None:
    """A time in milliseconds says nothing on another device."""
    limit = trial.limit
    if limit.metric != TIME_MS:
        return
    here = device_digest(this_device())
    if limit.device != here:
        reason = f"not judged: the limit was written for device {limit.device}, and this is {here}"
        trial.verdict = trial.unmeasured(reason)


def _verdict(trial: Trial, work: Work, status: Status, measurement: Measurement) -> Verdict:
    return trial.judged(status, measurement, work.subject.samples, len(work.subject.looks))


def _undecided(trial: Trial, work: Work, seconds: float | None) -> Verdict:
    """Why a trial is left open."""
    found = trial.last
    if found is None:
        reason = f"the time budget of {seconds:g} s ended before the first look; give more with --seconds"
        return trial.unmeasured(reason)
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
