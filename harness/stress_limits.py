"""Limits on the arithmetic of shading functions, and on stiff scenes: `[[stress]]` in lightmeter.toml.

    [[stress]]
    effect = "cook_torrance"    # or function = "d_ggx"; neither: every function
    metric = "faults"           # inputs where a result is NaN, infinite or wrongly negative
    max = 0

    [[stress]]
    function = "d_ggx"
    metric = "digits"           # that the worst input found keeps
    min = 3
    alpha = 0.002               # from there up; none: the declared domain
    format = "fp16"             # none: fp32

    [[stress]]
    metric = "albedo"           # the largest that a BRDF has; or "reciprocity": how one-sided it is at most
    max = 1.0

A limit is on the declared domain of the functions' arguments, α aside where `alpha` says so; or on a regime of the
table's columns, by `regime`. One on a law of reflection is on every BRDF among the functions, as the device evaluates
it over the declared domain. With `scene` in place of a function it is on stiff scenes, see stiff_limits.py.
"""

import time
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field, model_validator

from lightmeter.failures import UsageError
from lightmeter.hints import nearest
from lightmeter.progress import Report
from lightmeter.scenes.validation import Strict

if TYPE_CHECKING:
    from lightmeter.realtime.stress.findings import Cell
    from lightmeter.realtime.stress.laws import Laws
    from lightmeter.realtime.stress.naming import Subject
    from lightmeter.reports.verdict import Verdict

Name = Annotated[str, Field(strict=True, min_length=1, max_length=1000)]
ASKED = "asked for"
"""What the region of a limit is called among a function's regimes."""
LAWS = ("reciprocity", "albedo")


class StressEntry(Strict):
    """One `[[stress]]`."""

    effect: Name | None = None
    function: Name | None = None
    scene: Name | None = None
    metric: Literal["digits", "faults", "reciprocity", "albedo", "changed", "nrmse"]
    min: Annotated[float, Field(strict=True, ge=0, le=7, allow_inf_nan=False)] | None = None
    max: Annotated[float, Field(strict=True, ge=0, allow_inf_nan=False)] | None = None
    alpha: Annotated[float, Field(strict=True, gt=0, le=1, allow_inf_nan=False)] | None = None
    regime: Name | None = None
    format: Literal["fp32", "fp16", "r11g11b10f", "mediump"] = "fp32"
    seed: Annotated[int, Field(strict=True, ge=0, lt=2**32)] = 0

    @model_validator(mode="after")
    def _whole(self):
        if sum(on is not None for on in (self.effect, self.function, self.scene)) > 1:
            raise ValueError("a stress limit is on an effect, on a function or on stiff scenes, not on several")
        if self.scene is not None:
            return self._of_scenes()
        if self.metric in ("changed", "nrmse"):
            raise ValueError(f'a stress limit with metric = "{self.metric}" is on stiff scenes: expected scene = NAME')
        if self.alpha is not None and self.regime is not None:
            raise ValueError("a stress limit has alpha or a regime, not both")
        if (self.metric == "digits") != (self.min is not None) or (self.metric == "digits") != (self.max is None):
            raise ValueError('a stress limit is metric = "digits" with min, or another metric with max')
        if self.metric in LAWS and (self.alpha is not None or self.regime is not None or self.format != "fp32"):
            raise ValueError(f"a limit on {self.metric} is on the declared domain: leave out alpha, regime and format")
        return self._counted()

    def _of_scenes(self):
        if self.metric in ("digits", *LAWS) or self.max is None or self.min is not None:
            raise ValueError('a stress limit on scenes is metric = "faults", "changed" or "nrmse" with max')
        if self.alpha is not None or self.regime is not None or self.format != "fp32":
            raise ValueError("alpha, regime and format are of functions, and this stress limit is on scenes")
        return self._counted()

    def _counted(self):
        if self.metric == "faults" and self.max is not None and not self.max.is_integer():
            raise ValueError(f"faults are counted: max is a whole number, got {self.max:g}")
        return self

    @property
    def subject(self) -> str:
        """What it is on."""
        return self.function or self.effect or self.scene or "every function"

    @property
    def words(self) -> str:
        """ "digits >= 3 for α ≥ 0.002 in fp16"."""
        bound = f"digits >= {self.min:g}" if self.metric == "digits" else f"{self.metric} <= {self.max:g}"
        where = f" for α ≥ {self.alpha:g}" if self.alpha is not None else f" in {self.regime}" if self.regime else ""
        return f"{bound}{where}" + (f" as {self.format}" if self.format != "fp32" else "")


def judge_all(entries: Sequence[StressEntry], report: Report) -> "list[Verdict]":
    """A verdict for each limit, in their order.

    Raises:
        EffectError, UsageError: there is no such effect, function or regime, or the limit reaches no input.
    """
    from lightmeter.realtime.device import Device

    device, verdicts = Device(), []
    for done, entry in enumerate(entries):
        report("stress limits", done, len(entries))
        verdicts.append(_judge_law(entry, device) if entry.metric in LAWS else _judge(entry, device))
    return verdicts


def _judge(entry: StressEntry, device) -> "Verdict":
    from lightmeter.metrics.measurement import Measurement
    from lightmeter.reports.stress_results import command
    from lightmeter.reports.verdict import Verdict

    start = time.perf_counter()
    cells = _cells(entry, device)
    if not cells:
        raise UsageError(f"stress limit on {entry.subject}: {entry.words} reaches no input of these functions")
    if entry.metric == "digits":
        name = min(cells, key=lambda n: cells[n].digits)
        value, unit, held = cells[name].digits, "digits", cells[name].digits >= (entry.min or 0)
    else:
        name = max(cells, key=lambda n: sum(cells[n].counts.values()))
        value, unit = float(sum(sum(c.counts.values()) for c in cells.values())), "inputs"
        held = value <= (entry.max or 0)
    example, message = cells[name].example, ""
    if not held and example:
        what = cells[name].fault or f"{cells[name].digits:.1f} digits"
        message = f"{name}: {what}; see `{command(name, example)}`"
    lanes = sum(cell.lanes for cell in cells.values())
    return Verdict(
        f"stress/{entry.subject}/{entry.metric}",
        "PASS" if held else "FAIL",
        Measurement(value, unit=unit, how=f"{lanes} designed and searched inputs, seed {entry.seed}"),
        entry.words,
        message,
        time.perf_counter() - start,
        "stress",
        entry.subject,
        entry.metric,
        high=entry.max,
        low=entry.min,
        samples=lanes,
    )


def _cells(entry: StressEntry, device) -> "dict[str, Cell]":
    """The cell that the limit is on, of every function that has it."""
    from lightmeter.realtime.stress.regimes import REGIMES, Marks
    from lightmeter.realtime.stress.search import Stress

    if entry.regime is not None and entry.regime not in REGIMES:
        raise UsageError(f"stress limit: there is no regime {entry.regime!r}; {nearest(entry.regime, REGIMES)}")

    def asked(marks: Marks):
        if entry.alpha is None:
            return marks.declared
        return marks.usual & (False if marks.alpha is None else marks.alpha >= entry.alpha)

    found = {}
    for subject in _subjects(entry):
        stress = Stress(device, subject.name, subject.twin, subject.folder, entry.seed, {ASKED: asked})
        cell = stress.run().cells.get(entry.format, {}).get(entry.regime or ASKED)
        if cell is not None:
            found[subject.name] = cell
    return found


def _subjects(entry: StressEntry) -> "list[Subject]":
    from lightmeter.realtime.stress.naming import named, of_effects

    subjects = of_effects([entry.effect] if entry.effect else [])
    return named(entry.function, subjects) if entry.function else subjects


def _judge_law(entry: StressEntry, device) -> "Verdict":
    from lightmeter.metrics.measurement import Measurement
    from lightmeter.reports.stress_laws import law_command
    from lightmeter.reports.verdict import Verdict

    start = time.perf_counter()
    found = {name: laws.furthest(entry.metric) for name, laws in _laws(entry, device)}
    if not found:
        raise UsageError(f"stress limit on {entry.subject}: {entry.words} reaches no function that is a BRDF")
    name = max(found, key=lambda n: found[n][0] - found[n][1].error)
    value, extreme = found[name]
    held = value - extreme.error <= (entry.max or 0)
    message = f"{name}: {value:.5g}; see `{law_command(name, entry.metric, extreme)}`"
    return Verdict(
        f"stress/{entry.subject}/{entry.metric}",
        "PASS" if held else "FAIL",
        Measurement(
            value,
            value - extreme.error,
            value + extreme.error,
            how=f"designed and searched inputs of {len(found)} functions, seed {entry.seed}",
        ),
        entry.words,
        "" if held else message,
        time.perf_counter() - start,
        "stress",
        entry.subject,
        entry.metric,
        high=entry.max,
    )


def _laws(entry: StressEntry, device) -> "Iterator[tuple[str, Laws]]":
    """Of the functions that the law is one of."""
    from lightmeter.realtime.stress.laws import ALBEDO, hold_laws

    for subject in _subjects(entry):
        brdf = subject.twin.brdf
        if brdf and (brdf.whole or entry.metric != ALBEDO):
            laws = hold_laws(device, subject, entry.seed)
            assert laws is not None
            yield subject.name, laws
