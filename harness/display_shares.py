"""How much of the display image's error each display effect causes, on the exact image.

The players are the effects of the display chain; their errors are in code values 0…1, against the exact chain.
"""

from collections.abc import Callable

import numpy as np

from lightmeter.display_chain import Chained, display_steps
from lightmeter.game import Game
from lightmeter.metrics.flip import ldr_flip
from lightmeter.metrics.shapley import every_order
from lightmeter.noisy_errors import NoisyErrors, batch_groups
from lightmeter.realtime.graph import Plan
from lightmeter.reports import results as outcome
from lightmeter.reports.results import Attribution

METRICS: dict[str, Callable[[np.ndarray, np.ndarray], float]] = {
    "mse": lambda tested, exact: float(np.mean((tested - exact) ** 2, dtype=np.float64)),
    "flip": lambda tested, exact: float(ldr_flip(tested, exact).mean(dtype=np.float64)),
}


def attribute_display(plan: Plan, reference: np.ndarray) -> Attribution | None:
    """Share out the error of the display chain; None where no effect has a part in it.

    Args:
        reference: (K, H, W, 3) batches, K ≥ 8.
    """
    names = {step.effect: step.writes[0] for step in display_steps(plan)}
    if not names:
        return None
    game = Game(tuple(names), every_order(len(names)), None, reference)
    groups = batch_groups(len(reference))
    values = {metric: np.zeros((len(groups), len(game.orders.sets))) for metric in METRICS}
    for level, group in enumerate(groups):
        chain = Chained(plan, reference[group].mean(axis=0, dtype=np.float64))
        shown = [chain.whole(game.exact(int(players))) for players in game.orders.sets]
        for place, tested in enumerate(shown):
            if not np.array_equal(tested, shown[-1]):  # an exact effect gives the same picture
                for metric, error in METRICS.items():
                    values[metric][level, place] = error(tested, shown[-1])
    errors = {metric: NoisyErrors.of(game, found) for metric, found in values.items()}
    return Attribution(
        total={metric: found.total() for metric, found in errors.items()},
        residual={},
        players=tuple(
            outcome.Player(
                name,
                (term,),
                True,
                {metric: found.share(i) for metric, found in errors.items()},
                {metric: found.removed(i) for metric, found in errors.items()},
            )
            for i, (name, term) in enumerate(names.items())
        ),
        subsets=len(game.orders.sets),
        exhaustive=True,
    )
