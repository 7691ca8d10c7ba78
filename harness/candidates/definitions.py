"""Which definition of a rough surface an engine follows: its frame against both truths.

Engines differ on rough metals by definition: single scattering loses light between the facets, engines that compensate
bring it back. Neither is a mistake, so an engine is also held against the other truth.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from lightmeter.measuring import Display, Question, answer, answers
from lightmeter.metrics.measurement import Measurement
from lightmeter.progress import Report
from lightmeter.sides import Sides

NAMES = ("rmse", "flip")
Metrics = Mapping[str, Measurement]


def against_other(
    questions: Mapping[str, Question], reference: Sequence[np.ndarray], display: Display, report: Report
) -> dict[str, Metrics]:
    """Every engine's frame against another truth, over the same pixels.

    Args:
        questions: engine to what was asked of its frame against the usual truth.
        reference: (K, H, W, 3) batches of the other truth.
    """
    asked = {}
    for engine, question in questions.items():
        frame, mask = question.sides.tested[0], question.mask
        # Pixels that do not count are the frame's on both sides, so that filters see no error there.
        there = list(reference) if mask is None else [np.where(mask[..., None], one, frame) for one in reference]
        names = tuple(name for name in NAMES if name in question.names)
        asked[engine] = replace(question, names=names, sides=Sides([frame], there))
    return answers(asked, display, report)


def follows(truths: Mapping[str, Metrics]) -> str:
    """The truth that a frame is surely nearest to: its error's interval ends below all others'; "" for none.

    By RMSE in radiance, of a display image by FLIP.
    """
    metric = next(name for name in NAMES if all(name in found for found in truths.values()))
    ends = {name: (found[metric].low, found[metric].high) for name, found in truths.items()}
    for name, (_, high) in ends.items():
        others = [low for other, (low, _) in ends.items() if other != name]
        if high is not None and all(low is not None and high < low for low in others):
            return name
    return ""


def apart(one: Sequence[np.ndarray], other: Sequence[np.ndarray], display: Display) -> Measurement:
    """How far two truths are apart in a picture: RMSE between them, without what is their batches' noise."""
    return answer(Question(("rmse",), Sides(list(one), list(other))), display)["rmse"]
