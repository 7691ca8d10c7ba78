"""All candidates of a comparison: measured over the same pixels as our own frame, with their layers and pictures."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from lightmeter.candidates.candidate import OWN
from lightmeter.candidates.definitions import against_each, apart_words, follows, told_apart
from lightmeter.candidates.gathering import Gathered
from lightmeter.candidates.judging import Judged, count, filled, judge, own_result
from lightmeter.candidates.layer_buffers import Centres
from lightmeter.candidates.layer_errors import geometry_errors, layer_question, layer_sides
from lightmeter.candidates.layer_shares import layer_shares
from lightmeter.measuring import Display, Question, answers
from lightmeter.metrics.measurement import Measurement
from lightmeter.progress import Report
from lightmeter.realtime.renderer import Renderer
from lightmeter.reports import results as outcome
from lightmeter.sides import Sides
from lightmeter.truth import Truth


@dataclass(frozen=True, eq=False)
class Exhibit:
    """Two sides to be looked at.

    Attributes:
        name: unique in the report.
        engine: whose picture it is.
        terms: what it is judged on; empty for a whole frame.
        display: the transform that shows it, for a display image; None: the frame's.
        mask: (H, W) bool, where it says something; None: everywhere.
    """

    name: str
    engine: str
    terms: tuple[str, ...]
    sides: Sides
    caption: str
    display: Display | None
    mask: np.ndarray | None


@dataclass(frozen=True, eq=False)
class SideBySide:
    """What was found of the candidates.

    Attributes:
        results: ours first; empty where there is no candidate.
        exhibits: every candidate's frame, followed by its layers.
        notes: what the reader should know of the comparison.
    """

    results: tuple[outcome.Candidate, ...] = ()
    exhibits: tuple[Exhibit, ...] = ()
    notes: tuple[str, ...] = ()


def compare_candidates(
    gathered: Gathered,
    renderer: Renderer,
    truth: Truth,
    frame: np.ndarray,
    ours: tuple[dict[str, Measurement], outcome.Timing | None, str],
    display: Display,
    names: Sequence[str],
    shares: bool,
    report: Report,
    other: Truth | None = None,
) -> SideBySide:
    """Measure every candidate beside our own frame.

    Args:
        frame: ours, (H, W, 3) scene-linear.
        ours: our frame's metrics over all pixels, its time and how that was measured.
        display: our frame's display transform.
        names: the metrics of a frame.
        shares: whether errors are shared out among layers, where they make up the frame.
        other: another truth of the same scene and size that every engine is held against too.

    Raises:
        UsageError: a candidate's layers or masks do not fit the scene.
    """
    if not gathered.handed:
        return SideBySide()
    reference = truth.reference.batches
    centres = Centres.of(renderer, truth)
    judged = judge(truth.scene, centres.points.shape[0], reference, gathered.handed)
    mask = judged[0].mask
    questions = {one.name: one.question(names, reference) for one in judged}
    if mask is not None:
        sides = Sides([filled(frame, mask, reference)], reference)
        questions[""] = Question(tuple(names), sides, bounds=True, mask=mask)
    layers = {(one.name, name): sides for one in judged for name, sides in layer_sides(one, centres)}
    questions |= {f"{engine} {name}": layer_question(sides, mask) for (engine, name), sides in layers.items()}
    measured = answers(questions, display, report)
    metrics, time, how = ours
    found = [own_result(frame, measured.get("", metrics), time, how, mask)]
    for one in judged:
        terms = tuple(
            outcome.LayerError(name, one.term_of(name), measured[f"{engine} {name}"], count(mask, one.image))
            for engine, name in layers
            if engine == one.name
        )
        shared, why_not = layer_shares(one, centres, reference, display, report) if shares else (None, "")
        found.append(
            one.result(
                measured[one.name],
                terms + geometry_errors(one, centres),
                shared.attribution if shared else None,
                (why_not,) if why_not else (),
            )
        )
    notes = ()
    if other is not None:
        frames = {one.name: questions[one.name] for one in judged}
        frames[OWN] = questions.get("", Question(tuple(names), Sides([frame], reference), bounds=True))
        found, notes = _by_either_truth(found, frames, (truth, other), display, report)
    return SideBySide(tuple(found), tuple(_exhibits(judged, layers, reference)), notes)


def _by_either_truth(
    found: list[outcome.Candidate],
    frames: dict[str, Question],
    truths: tuple[Truth, Truth],
    display: Display,
    report: Report,
) -> tuple[list[outcome.Candidate], tuple[str, ...]]:
    """The engines with what they err by against either truth and which one they follow; and where the two differ."""
    references = {truth.scattering: truth.reference.batches for truth in truths}
    where = told_apart(references)
    errors = against_each(frames, references, where, display, report)
    judged = [replace(one, truths=errors[one.name], follows=follows(errors[one.name])) for one in found]
    return judged, (apart_words(references, where, display),)


def _exhibits(
    judged: Sequence[Judged], layers: dict[tuple[str, str], Sides], reference: list[np.ndarray]
) -> Iterator[Exhibit]:
    """Every engine's frame, then its layers."""
    for one in judged:
        corrected = [finding.fault for finding in one.findings if finding.corrected]
        caption = f"The frame of {one.name}" + (f", corrected as asked: {', '.join(corrected)}." if corrected else ".")
        yield Exhibit(one.name, one.name, (), Sides([one.image], reference), caption, one.handed.display, one.mask)
        for (engine, name), both in layers.items():
            if engine == one.name:
                terms, words = (one.term_of(name),), f"The layer {name} of {engine}, weighted as in the frame."
                yield Exhibit(f"{engine} {name}", engine, terms, both, words, None, one.mask)
