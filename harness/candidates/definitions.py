"""Which definition of a rough surface an engine follows: its frame against both truths.

Engines differ on rough metals by definition: single scattering loses light between the facets, engines that compensate
bring it back. Neither is a mistake, so an engine is also held against the other truth: over the pixels that tell the
two apart, since what an engine does elsewhere says nothing of it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from lightmeter.measuring import Display, Question, answer, answers
from lightmeter.metrics.measurement import Measurement
from lightmeter.progress import Report
from lightmeter.reports.significant import show_measurement
from lightmeter.sides import Sides

NAMES = ("rmse", "flip")
SURE = 4.0
"""Standard errors that two truths are apart in a pixel that counts; of 8 batches of noise 1 pixel in 200 is."""

Metrics = Mapping[str, Measurement]
References = Mapping[str, Sequence[np.ndarray]]
"""Truth to its batches, (K, H, W, 3)."""


def told_apart(references: References) -> np.ndarray:
    """(H, W) bool: where two truths are apart by more than their noise, in the mean of the channels."""
    one, other = (np.asarray(batches, np.float64).mean(axis=-1) for batches in references.values())
    difference = np.abs(other.mean(axis=0) - one.mean(axis=0))
    error = np.sqrt(sum(batches.var(axis=0, ddof=1) / len(batches) for batches in (one, other)))
    return difference > SURE * error


def against_each(
    questions: Mapping[str, Question], references: References, where: np.ndarray, display: Display, report: Report
) -> dict[str, dict[str, Metrics]]:
    """Engine to truth to the errors of its frame.

    Args:
        questions: engine to what was asked of its whole frame.
        where: (H, W) bool, pixels that count, as far as the engine's question counts them.
    """
    asked, places = {}, {}
    for engine, question in questions.items():
        names = tuple(name for name in NAMES if name in question.names)
        mask = where if question.mask is None else where & question.mask
        for truth, batches in references.items():
            if mask.any():
                sides = Sides(question.sides.tested, list(batches))
                places[f"{engine} {truth}"] = engine, truth
                asked[f"{engine} {truth}"] = replace(question, names=names, sides=sides, mask=mask)
    found: dict[str, dict[str, Metrics]] = {engine: {} for engine in questions}
    for name, measured in answers(asked, display, report).items():
        engine, truth = places[name]
        found[engine][truth] = measured
    return {engine: {truth: each[truth] for truth in references if truth in each} for engine, each in found.items()}


def follows(truths: Mapping[str, Metrics]) -> str:
    """The truth that a frame is surely nearest to: its error's interval ends below all others'; "" for none.

    By RMSE in radiance; where that leaves it open, or of a display image, by FLIP, which fireflies hardly move.
    """
    for metric in NAMES:
        ends = {name: (found[metric].low, found[metric].high) for name, found in truths.items() if metric in found}
        for name, (_, high) in ends.items():
            others = [low for other, (low, _) in ends.items() if other != name]
            if high is not None and others and all(low is not None and high < low for low in others):
                return name
    return ""


def apart_words(references: References, where: np.ndarray, display: Display) -> str:
    """How far two truths are apart in a picture, without what is their batches' noise, and in how many pixels."""
    one, other = references
    if not where.any():
        return f"The truths {one} and {other} cannot be told apart in any pixel, nor which one an engine follows."
    sides = Sides(list(references[one]), list(references[other]))
    distance = show_measurement(answer(Question(("rmse",), sides, mask=where), display)["rmse"])
    return (
        f"The truths {one} and {other} can be told apart in {where.sum():,} of {where.size:,} pixels, where they are "
        f"{distance} RMSE apart. Which one an engine follows is judged there."
    )
