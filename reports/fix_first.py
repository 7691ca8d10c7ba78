"""What to make exact first, in plain sentences: the error that goes away where one approximation alone is exact."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.metric_words import error_phrase
from lightmeter.reports.percentages import percent_of
from lightmeter.reports.results import Attribution, Player, Results, Together
from lightmeter.reports.significant import show_measurement, show_number

Verdict = Literal["fix", "unsure", "worse", "exact"]

_ORDER: tuple[Verdict, ...] = ("fix", "unsure", "worse", "exact")
_NOTHING = 5e-4
"""The fraction of the frame's error below which a player is called exact: it would print as 0.0 %."""


@dataclass(frozen=True)
class Advice:
    """What comes of making one player exact, or two whose errors make up for one another.

    Attributes:
        name: of the player; of two with "and" between them.
        verdict: "fix": its interval of removed error is above 0; "worse": below, so that its error makes up for
            another's; "unsure": it holds 0, or there is none; "exact": all of it is too small to count.
        removed: in percent of the frame's error where that can be told from 0, else in the metric's unit.
        sentence: says it, with the interval and the milliseconds.
    """

    name: str
    verdict: Verdict
    removed: Measurement
    sentence: str


def fix_first(results: Results, attribution: Attribution, metric: str) -> list[Advice]:
    """One advice per player, and per pair that is worth more.

    What is worth fixing comes first, then what noise hides, then what would make the frame worse. Within each, what
    removes most comes first.
    """
    times = {effect.effect: effect.time_ms.median for effect in results.effects if effect.time_ms}
    total = attribution.total[metric]
    found = [
        _advice(player, player.removed[metric], total, metric, times.get(player.name))
        for player in attribution.players
        if metric in player.removed
    ]
    pairs = (pair for pair in attribution.together if metric in pair.removed)
    joint = (_joint(pair, attribution.players, total, metric) for pair in pairs)
    found += [advice for advice in joint if advice is not None]
    return sorted(found, key=lambda advice: (_ORDER.index(advice.verdict), -_sortable(advice.removed.value)))


def _advice(player: Player, removed: Measurement, total: Measurement, metric: str, ms: float | None) -> Advice:
    verdict = "exact" if _counts_for_nothing(removed, total) else _verdict(removed)
    shown = percent_of(removed, total) or removed
    error = error_phrase(metric)
    if verdict == "fix":
        cost = _cost(player, ms)
        sentence = f"Making {player.name} exact would remove {show_measurement(shown)} of the frame's {error}{cost}."
    elif verdict == "worse":
        added = show_measurement(_negated(shown))
        sentence = (
            f"Making {player.name} exact alone would make the frame worse, by {added} of the frame's {error}: "
            "its error makes up for another's."
        )
    elif verdict == "exact":
        sentence = f"{player.name} is as good as exact: less than {100 * _NOTHING:g} % of the frame's {error} is its."
    elif removed.low is None or removed.high is None or not math.isfinite(removed.value):
        sentence = f"What making {player.name} exact would remove is not known: {show_measurement(shown)}."
    else:
        sentence = f"What making {player.name} exact would remove cannot be told from noise: {show_measurement(shown)}."
    return Advice(player.name, verdict, shown, sentence)


def _joint(pair: Together, players: Sequence[Player], total: Measurement, metric: str) -> Advice | None:
    """What comes of making both exact; None where that does not stand out of what either removes alone."""
    removed = pair.removed[metric]
    alone = [
        player.removed[metric].high for player in players if player.name in pair.names and metric in player.removed
    ]
    if _verdict(removed) != "fix" or any(high is None or high >= (removed.low or 0.0) for high in alone):
        return None
    shown = percent_of(removed, total) or removed
    name = " and ".join(pair.names)
    sentence = (
        f"Making {name} exact together would remove {show_measurement(shown)} of the frame's {error_phrase(metric)}: "
        "their errors make up for one another."
    )
    return Advice(name, "fix", shown, sentence)


def _counts_for_nothing(removed: Measurement, total: Measurement) -> bool:
    ends = (removed.low, removed.high)
    return total.value > 0 and all(end is not None and abs(end) < _NOTHING * total.value for end in ends)


def _verdict(removed: Measurement) -> Verdict:
    low, high = removed.low, removed.high
    if low is None or high is None or not math.isfinite(removed.value):
        return "unsure"
    if low > 0:
        return "fix"
    return "worse" if high < 0 else "unsure"


def _cost(player: Player, ms: float | None) -> str:
    if not player.approximated:
        return "; no effect that takes part approximates it"
    return f"; it takes {show_number(ms)} ms" if ms is not None else ""


def _negated(removed: Measurement) -> Measurement:
    """The same as a loss; both ends are there, or it would not be called one."""
    assert removed.low is not None
    assert removed.high is not None
    return Measurement(-removed.value, -removed.high, -removed.low, removed.unit)


def _sortable(value: float) -> float:
    return -math.inf if math.isnan(value) else value
