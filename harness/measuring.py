"""Metrics of several comparisons, two at a time."""

from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, replace

import numpy as np

from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.mse import RADIANCE
from lightmeter.metrics.registry import find_metric, measure_all
from lightmeter.metrics.ssim import WINDOW
from lightmeter.progress import Report
from lightmeter.sides import Sides

Display = Callable[[np.ndarray], np.ndarray]
WORKERS = 2
"""NumPy and SciPy let go of the interpreter in what takes long; more workers than this only cost memory."""


@dataclass(frozen=True)
class Question:
    """Which metrics of which two sides.

    Attributes:
        bounds: whether metrics that noise biases get bounds, for twelve error maps in place of two.
        mask: (H, W) boolean, True where pixels count; None: all.
        confidence: of every interval.
        display: the display transform for this question alone; None: the frame's.
    """

    names: tuple[str, ...]
    sides: Sides
    bounds: bool = False
    mask: np.ndarray | None = None
    confidence: float = 0.95
    display: Display | None = None


def answers(questions: Mapping[str, Question], display: Display, report: Report) -> dict[str, dict[str, Measurement]]:
    """The metrics asked for, by the questions' names.

    Args:
        display: the frame's display transform, put on both sides of display metrics.
    """
    with ThreadPoolExecutor(WORKERS) as pool:
        running = {pool.submit(answer, question, display): name for name, question in questions.items()}
        found = {}
        for done, future in enumerate(as_completed(running), 1):
            found[running[future]] = future.result()
            report("metrics", done, len(running))
    return found


def answer(question: Question, display: Display) -> dict[str, Measurement]:
    """The metrics of one pair of sides."""
    sides = question.sides
    tested = sides.tested[0] if len(sides.tested) == 1 else sides.tested
    comparison = Comparison(tested, sides.truth, question.mask, question.confidence)
    linear = sides.space == "scene-linear"
    small = min(comparison.height, comparison.width) < WINDOW
    usable = [name for name in question.names if name != "ssim" or not small]
    known = {option for name in usable for option in find_metric(name).options}
    options = {"display": (question.display or display) if linear else clipped, "bound": question.bounds}
    found = measure_all(usable, comparison, **{name: value for name, value in options.items() if name in known})
    if not linear:  # a display value is a pure number
        found = {name: replace(m, unit="" if m.unit == RADIANCE else m.unit) for name, m in found.items()}
    return found


def clipped(image: np.ndarray) -> np.ndarray:
    """A display image as a display shows it."""
    return np.clip(image, 0.0, 1.0)
