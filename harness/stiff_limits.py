"""Limits on stiff scenes: `[[stress]]` with a scene in lightmeter.toml.

    [[stress]]
    scene = "*"                 # stiff scenes: a name, or a pattern of names
    metric = "faults"           # pixels of either side that are not finite; 1 where it is refused wrongly, or is not
    max = 0

    [[stress]]
    scene = "scenes/hall.toml"  # a scene of your own: its copies of other sizes and in another place
    metric = "changed"          # RMS of the frame less that of the scene it must look like, over the reference's mean
    max = 0.001

    [[stress]]
    scene = "slivers"
    metric = "nrmse"            # of the frame, judged as any [[limit]] is: batches are added until it is decided
    max = 0.2

Every scene has a verdict of its own. What is not finite and what a frame changes have no noise: PASS or FAIL, and
UNDECIDED where the reference is black, so that nothing can be a part of its mean.
"""

from collections.abc import Sequence
from fnmatch import fnmatchcase
from pathlib import Path

from lightmeter.conditions import Conditions
from lightmeter.failures import UsageError
from lightmeter.hints import nearest
from lightmeter.limit_scenes import find_scenes
from lightmeter.limits import DEFAULT_SPP, FRAME, Limit
from lightmeter.metrics.measurement import Measurement
from lightmeter.progress import Report
from lightmeter.reports.stiff_results import Finding, blamed
from lightmeter.reports.verdict import Status, Verdict
from lightmeter.scenes.stiff import CASES, PREFIX
from lightmeter.scenes.stiff.case import StiffCase
from lightmeter.scenes.stiff.copies import copies
from lightmeter.stress_limits import StressEntry

NRMSE = "nrmse"
Cases = dict[str, StiffCase]


def error_limits(entries: Sequence[StressEntry]) -> tuple[Limit, ...]:
    """The limits on errors among them, as limits on the frames of scenes.

    Raises:
        UsageError: there is no such scene, or it is refused.
    """
    return tuple(limit for entry in entries if entry.metric == NRMSE for limit in _error_limits(entry))


def _error_limits(entry: StressEntry) -> list[Limit]:
    cases = {name: case for name, case in _of_library(entry).items() if not case.refused}
    if not cases:
        hint = nearest(entry.subject, [name for name, case in CASES.items() if not case.refused])
        raise UsageError(
            f"{_place(entry)}: {NRMSE} is of a stiff scene that is rendered; {hint}. A scene of your own has [[limit]]"
        )
    return [
        Limit(
            _place(entry),
            PREFIX + name,
            FRAME,
            NRMSE,
            entry.max,
            None,
            Conditions(case.size, DEFAULT_SPP, entry.seed, None, (), (), (), case.settings),
        )
        for name, case in cases.items()
    ]


def judge_scenes(entries: Sequence[StressEntry], file: Path, report: Report) -> list[Verdict]:
    """A verdict for each scene of each limit but those on errors, in their order; a scene is rendered once a seed.

    Args:
        file: the limits file, beside which scenes of the user's own are looked for.

    Raises:
        SceneError, UsageError: there is no such scene, or none that must look like another.
    """
    asked = [(entry, _cases(entry, file)) for entry in entries if entry.metric != NRMSE]
    found = {}
    for seed in dict.fromkeys(entry.seed for entry, _ in asked):
        cases = {name: case for entry, some in asked if entry.seed == seed for name, case in some.items()}
        found |= {(seed, one.name): one for one in _examine(cases, seed, report)}
    return [
        _verdict(entry, case, found[entry.seed, name])
        for entry, cases in asked
        for name, case in cases.items()
        if entry.metric == "faults" or case.like
    ]


def _examine(cases: Cases, seed: int, report: Report):
    from lightmeter.stiff_scenes import examine

    words = f" --seed {seed}" if seed else ""
    for done, found in enumerate(examine(cases, {**CASES, **cases}, seed, words=words)):
        report("stiff scenes", done + 1, len(cases))
        yield found


def _cases(entry: StressEntry, file: Path) -> Cases:
    """The scenes that a limit is on, with those that they must look like."""
    cases = _of_library(entry)
    if not cases:
        for source in find_scenes(entry.subject, file, _place(entry)):
            cases |= copies(source)
    if entry.metric == "changed" and not any(case.like for case in cases.values()):
        alike = [name for name, case in CASES.items() if case.like]
        raise UsageError(f"{_place(entry)}: {entry.subject} need not look like another; {nearest('', alike)}")
    return cases


def _of_library(entry: StressEntry) -> Cases:
    return {name: case for name, case in CASES.items() if fnmatchcase(name, entry.subject)}


def _place(entry: StressEntry) -> str:
    return f"stress limit on {entry.subject}"


def _verdict(entry: StressEntry, case: StiffCase, found: Finding) -> Verdict:
    measured, unit, why = _measured(entry, case, found)
    held = measured is not None and measured <= (entry.max or 0)
    status: Status = "UNDECIDED" if measured is None else "PASS" if held else "FAIL"
    message = "" if held else f"{found.name}: {why}; see `{found.commands[0]}`"
    return Verdict(
        f"stress/{found.name}/{entry.metric}",
        status,
        None if measured is None else Measurement(measured, unit=unit, how=f"both sides, seed {entry.seed}"),
        entry.words,
        message,
        found.seconds,
        "stress",
        found.name,
        entry.metric,
        high=entry.max,
        reason=why if measured is None else "",
    )


def _measured(entry: StressEntry, case: StiffCase, found: Finding) -> tuple[float | None, str, str]:
    """What the limit is on, its unit, and what is to be said where it does not hold; None: it has no value."""
    if entry.metric == "faults":
        missing = f"it should be refused for {case.refused}" if case.refused and not found.refused else ""
        amiss = found.refused != bool(case.refused) or case.refused not in found.words
        return float(found.faults + amiss), "faults", "; ".join(filter(None, (missing, found.words)))
    if found.refused or not found.finite:
        return float("nan"), "", found.words
    if found.frame_changed is None:
        return None, "", f"the reference of {found.like} is black: a change has nothing to be a part of"
    effects = ", ".join([*(f"{name} {share:.3g}" for name, share in blamed(found)), *found.lengths])
    return found.frame_changed, "", f"it is not as {found.like}: {effects or 'nothing that is named'} changed"
