"""Knobs that change nothing of what a sweep measures: they are told in a line, and no row is spent on them."""

from collections.abc import Hashable, Sequence

from lightmeter.knob_words import Visit


def idle_knobs(visits: Sequence[Visit], pictures: Sequence[Hashable]) -> dict[str, list[int]]:
    """Knobs that are varied and make no difference, whatever the others: with the settings that are needless for it.

    A knob is idle where settings that differ in it alone have the same picture, all of them. That may be so because
    another knob leaves it out, because the scene has nothing that it acts on, or because it only costs time. Where it
    makes a difference for some of its values it is not idle.

    Args:
        pictures: what stands for everything that is judged of a setting, equal where that is equal bit for bit.

    Returns:
        Knob to indices of `visits`: all but the first of those that differ in it alone. None is needless twice.
    """
    left = list(range(len(visits)))
    found: dict[str, list[int]] = {}
    for knob in dict.fromkeys(name for visit in visits for name in visit.varied):
        alike: dict[tuple, list[int]] = {}
        for index in left:
            others = tuple(item for item in visits[index].knobs.items() if item[0] != knob)
            alike.setdefault(others, []).append(index)
        compared = [group for group in alike.values() if len(group) > 1]
        if compared and all(len({pictures[index] for index in group}) == 1 for group in compared):
            found[knob] = [index for group in compared for index in group[1:]]
            left = [index for index in left if index not in found[knob]]
    return found
