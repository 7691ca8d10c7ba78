"""What changes nothing that a sweep measures: it is told in a line, and no row is spent on it."""

from collections.abc import Hashable, Sequence

from lightmeter.knob_words import Visit


def needless(visits: Sequence[Visit], pictures: Sequence[Hashable]) -> dict[str, list[int]]:
    """The settings of which another tells all, by the knob that makes no difference.

    A knob is idle where settings that differ in it alone have the same picture, all of them. That may be so because
    another knob leaves it out, because the scene has nothing that it acts on, or because it only costs time. Of a knob
    that is varied by itself, single values may make no difference too: they have the current setting's picture.

    Args:
        pictures: what stands for everything that is judged of a setting, equal where that is equal bit for bit.

    Returns:
        Knob to indices of `visits`, none twice. Of settings that differ in an idle knob alone the first is left.
    """
    left = list(range(len(visits)))
    found: dict[str, list[int]] = {}
    for knob in dict.fromkeys(name for visit in visits for name in visit.varied):
        alike: dict[tuple, list[int]] = {}
        for index in left:
            others = tuple(item for item in visits[index].knobs.items() if item[0] != knob)
            alike.setdefault(others, []).append(index)
        compared = [group for group in alike.values() if len(group) > 1]
        if all(len({pictures[index] for index in group}) == 1 for group in compared):
            idle = [index for group in compared for index in group[1:]]
        else:
            current = {pictures[index] for index in left if not visits[index].varied}
            idle = [index for index in left if visits[index].varied == (knob,) and pictures[index] in current]
        if idle:
            found[knob] = idle
            left = [index for index in left if index not in idle]
    return found
