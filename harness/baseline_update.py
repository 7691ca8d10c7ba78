"""`lightmeter gate --update`: measures what regressions are held against, and stores it."""

from collections.abc import Sequence
from pathlib import Path

from lightmeter.baseline import Stored, read_baseline, versions_of
from lightmeter.cases import Case
from lightmeter.device import device_digest
from lightmeter.gating import decide
from lightmeter.limit import Limit
from lightmeter.planning import this_device
from lightmeter.progress import Report, silent
from lightmeter.reports.significant import show_measurement, show_number
from lightmeter.trials import Trial, start_trials


def update(
    pairs: Sequence[tuple[Limit, Case]],
    path: Path,
    confidence: float,
    seconds: float | None,
    report: Report = silent,
) -> tuple[list[str], list[str]]:
    """Measure every regression's number until it is precise enough for its limit, or the budget ends; write the file.

    Returns:
        What was stored, a line each, with what it replaces; and what was not, or not well, with the reason.
    """
    baseline, device = read_baseline(path), this_device()
    trials = start_trials(pairs, confidence)
    decide(trials, seconds, report)
    lines, refused = [], []
    for trial in trials:
        stored, verdict = _stored(trial, device), trial.verdict
        assert verdict is not None
        if stored is None:
            refused.append(f"{trial.name} is not stored: {verdict.reason or verdict.message}")
            continue
        before = baseline.values.get(trial.name)
        was = "new" if before is None else f"was {show_number(before.value, 5)}"
        assert verdict.measurement is not None
        lines.append(f"{trial.name}: {show_measurement(verdict.measurement)} ({was}, {stored.samples} samples)")
        if verdict.status == "UNDECIDED":
            half = (stored.high - stored.low) / 2
            lines.append(
                f"  its interval of ± {show_number(half, 2)} is wide for a regression of {trial.limit.regression:g}: "
                "a gate may stay undecided; a larger spp narrows it"
            )
        baseline.put(trial.name, stored, device)
    baseline.write(path)
    return [*lines, f"baseline: {path}"], refused


def _stored(trial: Trial, device) -> Stored | None:
    """The value to keep; None where there is none to trust."""
    found, verdict = trial.last, trial.verdict
    if found is None or verdict is None or verdict.status == "FAIL" or found.heavy:
        return None
    m = found.measurement
    if m.low is None or m.high is None:
        return None
    value, low, high, error = (float(f"{number:.9g}") for number in (m.value, m.low, m.high, trial.alpha))
    return Stored(value, low, high, error, verdict.samples, device_digest(device), versions_of(device))
