"""What was judged, as error maps."""

from collections.abc import Sequence

import numpy as np

from lightmeter.measuring import clipped
from lightmeter.metrics.flip import ldr_flip
from lightmeter.reports.pictures import ErrorMap, flip_error
from lightmeter.trials import Trial


def error_maps(trials: Sequence[Trial]) -> dict[tuple[str, str], ErrorMap]:
    """FLIP of everything whose limit saw an image, by (case, what)."""
    found = {}
    for trial in trials:
        key = trial.case.name, trial.limit.what
        sides = trial.sides
        if sides is None or key in found:
            continue
        display = trial.case.display if sides.space == "scene-linear" else clipped
        tested, truth = display(sides.tested[0]), display(sides.truth[0])
        bad = np.logical_not(np.isfinite(tested).all(axis=2))
        error = ldr_flip(np.where(np.expand_dims(bad, 2), truth, tested), truth)
        found[key] = flip_error(np.where(bad, np.nan, error))
    return found
