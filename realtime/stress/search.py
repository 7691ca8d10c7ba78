"""Stresses one function: designed extremes, then a search for worse ones around the worst found so far."""

import math
import zlib
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from pathlib import Path
from types import MappingProxyType

import numpy as np

from ..device import Device
from ..glsl_on_device import FunctionOnDevice
from ..twin import Twin
from .design import Design, Inputs, joined
from .findings import FAULTS, FORMATS, Cell, Example, Stressed
from .half_floats import FunctionInHalfFloats
from .judging import EPS, HALF_NORMAL, HALF_STEP, SMALLEST, Verdict, attainable, exact_results, judge, judged_slots
from .regimes import Marks, marks_of

MOST_DIGITS = 7.2
"""−log₁₀ of half of float32's ε."""
KEPT = 0.01
"""The relative error that a safe domain keeps."""
Regime = Callable[[Marks], np.ndarray]
NONE: Mapping[str, Regime] = MappingProxyType({})
STEPS = {"mediump": HALF_STEP}
"""Half a rounding of the inputs, where it is not float32's."""
TARGETS = {"fp32": "f4", "fp16": "f2", "r11g11b10f": "r11g11b10f"}


def digits(relative: float) -> float:
    """Decimal digits that a relative error leaves, 0 to 7.2."""
    return max(0.0, min(MOST_DIGITS, -math.log10(max(relative, 1e-300))))


class Stress:
    """A function under stress.

    Args:
        name: what the findings are called.
        folder: where the function's file lies.
        seed: names the random numbers; the function's name goes into it.
        asked: further regimes that the findings are to have, by name: of the marks a mask (n,).
    """

    def __init__(
        self, device: Device, name: str, twin: Twin, folder: Path, seed: int = 0, asked: Mapping[str, Regime] = NONE
    ) -> None:
        self.name, self.twin, self._asked = name, twin, asked
        self._function = FunctionOnDevice(device, twin, folder)
        self._in_half_floats = cache(lambda: FunctionInHalfFloats(device, twin, folder))
        self.design = Design(twin, np.random.default_rng((seed, zlib.crc32(name.encode()))))
        self._cells: dict[str, dict[str, Cell]] = {}
        self._elite: Inputs | None = None
        self._unsafe: dict[str, float] = {}
        self._least: dict[str, float] = {}
        self._largest: dict[str, Example] = {}
        self._signed: set[int] = set()

    def run(self, designed: int = 6144, generations: int = 6, children: int = 1024) -> Stressed:
        """The findings, in all formats.

        Args:
            designed: inputs of the designed set; as many ordinary ones again by a third.
            generations: steps of the search.
            children: inputs of each step.
        """
        usual = self.design.ordinary(designed // 3)
        found = exact_results(self.twin, usual)
        self._signed = {slot for slot in judged_slots(self.twin) if (found[slot] < 0).any()}
        inputs = joined(usual, self.design.extremes(designed))
        exact = exact_results(self.twin, inputs)
        self._take("fp32", inputs, exact)
        for _ in range(generations):
            fresh = self.design.extremes(children // 4)
            assert self._elite is not None
            bred = self.design.children(self._elite, children - children // 4)
            self._take("fp32", joined(fresh, bred))
        assert self._elite is not None
        inputs = joined(inputs, self._elite)
        exact = exact_results(self.twin, inputs)
        for name in [*FORMATS][1:]:
            if name != "r11g11b10f" or (self.twin.result == "vec3" and not self._signed and len(exact) == 1):
                self._take(name, inputs, exact)
        self._condition()
        safe = {
            name: None if (bad := self._unsafe.get(name, 0.0)) >= 1 else max(bad, self._least[name])
            for name in self._least
        }
        return Stressed(self.name, self.twin.file, self._cells, safe, self._largest)

    def at(self, inputs: Inputs) -> dict[str, Example]:
        """The function at one input (a lane of each argument), in every format."""
        exact = exact_results(self.twin, inputs)
        examples = {}
        for name in FORMATS:
            if name == "r11g11b10f" and (self.twin.result != "vec3" or len(exact) > 1 or (exact[0] < 0).any()):
                continue
            got = self._got(name, inputs)
            verdict = self._verdict(name, inputs, got, exact)
            example = self._example(0, inputs, got, exact, verdict)
            (examples[name],) = self._attained([example], STEPS.get(name, EPS / 2))
        return examples

    def _got(self, form: str, inputs: Inputs) -> list[np.ndarray]:
        return self._in_half_floats()(inputs) if form == "mediump" else self._function(inputs, TARGETS[form])

    def _verdict(self, form: str, inputs: Inputs, got, exact) -> Verdict:
        smallest = SMALLEST if form == "fp32" else HALF_NORMAL
        return judge(self.twin, inputs, got, exact, self._signed, smallest, 2 * STEPS.get(form, EPS / 2))

    def _take(self, form: str, inputs: Inputs, exact: list[np.ndarray] | None = None) -> None:
        """Evaluate lanes, and keep the worst of each regime."""
        exact = exact_results(self.twin, inputs) if exact is None else exact
        got = self._got(form, inputs)
        verdict = self._verdict(form, inputs, got, exact)
        marks = marks_of(self.design.arguments, inputs)
        cells = self._cells.setdefault(form, {})
        for regime, mask in {**marks.lanes, **{name: of(marks) for name, of in self._asked.items()}}.items():
            if not mask.any():
                continue
            cell = cells.setdefault(regime, Cell())
            cell.lanes += int(mask.sum())
            for fault, where in zip(FAULTS, (verdict.nan, verdict.inf, verdict.negative), strict=True):
                found = np.flatnonzero(where & mask)
                cell.counts[fault] += len(found)
                if len(found) and fault not in cell.faults:
                    cell.faults[fault] = self._example(found[0], inputs, got, exact, verdict)
            lane = int(np.argmax(np.where(mask, verdict.relative, -1)))
            if cell.worst is None or verdict.relative[lane] > cell.worst.relative:
                cell.worst = self._example(lane, inputs, got, exact, verdict)
        if form == "fp32":
            self._breed(inputs, verdict, marks)
            self._bound(inputs, got, exact, verdict, marks)

    def _breed(self, inputs: Inputs, verdict: Verdict, marks: Marks) -> None:
        """The eight worst lanes of each regime so far are the next parents."""
        pool, worth = inputs, verdict.relative + 1e9 * (verdict.nan | verdict.inf)
        chosen = set(np.argsort(-worth)[:8].tolist())
        for mask in marks.lanes.values():
            lanes = np.flatnonzero(mask)
            chosen |= set(lanes[np.argsort(-worth[lanes])[:8]].tolist())
        best = [x[:, sorted(chosen)] for x in pool]
        self._elite = best if self._elite is None else joined([x[:, -512:] for x in self._elite], best)

    def _bound(self, inputs: Inputs, got, exact, verdict: Verdict, marks: Marks) -> None:
        """The largest errors of the declared domain, and what α and cosine keep 1 %."""
        broken = verdict.nan | verdict.inf | (verdict.relative > KEPT)
        alpha, cosine = marks.alpha, marks.cosine
        usual = marks.usual
        if alpha is not None:
            self._safe("α", alpha, broken & usual & (True if cosine is None else cosine >= 1e-3), usual)
        if cosine is not None:
            self._safe("cosine", cosine, broken & marks.declared & (True if alpha is None else alpha >= 1e-3), usual)
        for kind, values in (("relative", verdict.relative), ("absolute", verdict.absolute)):
            lane = int(np.argmax(np.where(marks.declared, values, -1)))
            if kind not in self._largest or values[lane] > getattr(self._largest[kind], kind):
                self._largest[kind] = self._example(lane, inputs, got, exact, verdict)

    def _safe(self, name: str, values: np.ndarray, broken: np.ndarray, usual: np.ndarray) -> None:
        tested = values[usual & (values > 0)]
        if len(tested):
            self._least[name] = min(self._least.get(name, np.inf), float(tested.min()))
        if broken.any():
            self._unsafe[name] = max(self._unsafe.get(name, 0.0), float(values[broken].max()))

    def _example(self, lane: int, inputs: Inputs, got, exact, verdict: Verdict) -> Example:
        bad = verdict.nan[lane] or verdict.inf[lane]
        relative = float("inf") if bad else float(verdict.relative[lane])
        return Example(
            {a.name: x[:, lane].tolist() for a, x in zip(self.design.arguments, inputs, strict=True)},
            [float(v) for g in got for v in g[:, lane]],
            [float(v) for e in exact for v in e[:, lane]],
            relative,
            float("inf") if bad else float(verdict.absolute[lane]),
            0.0 if bad else digits(relative),
        )

    def _condition(self) -> None:
        """Say of each worst input what could have been kept."""
        for form, regimes in self._cells.items():
            cells = [cell for cell in regimes.values() if cell.worst]
            worst = self._attained([cell.worst for cell in cells if cell.worst], STEPS.get(form, EPS / 2))
            for cell, example in zip(cells, worst, strict=True):
                cell.worst = example
        self._largest = dict(zip(self._largest, self._attained(list(self._largest.values())), strict=True))

    def _attained(self, examples: list[Example], step: float = EPS / 2) -> list[Example]:
        if not examples:
            return []
        lanes = [np.array([e.inputs[a.name] for e in examples]).T for a in self.design.arguments]
        change = attainable(self.twin, lanes, step)
        return [replace(e, attainable=digits(float(c))) for e, c in zip(examples, change, strict=True)]
