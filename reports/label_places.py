"""Where to write the names of points in a drawing, so that few of them cover one another.

Places around each point are tried in turn, the names one after the other (greedy; Christensen, Marks and Shieber 1995,
"An empirical study of algorithms for point-feature label placement", find it worse than a search, and for the few
engines of a report good enough).
"""

from collections.abc import Sequence
from dataclasses import dataclass

_LINE = 16.0
_GAP = 10.0
# To which side a name stands, and how many lines below its point; the first is preferred.
_PLACES = tuple((side, line) for line in (0, -1, 1, -2, 2, -3, 3) for side in ("start", "end", "middle"))


@dataclass(frozen=True)
class Box:
    """A rectangle; y runs downwards."""

    left: float
    top: float
    right: float
    bottom: float

    def shared(self, other: "Box") -> float:
        """The area of the overlap."""
        width = min(self.right, other.right) - max(self.left, other.left)
        height = min(self.bottom, other.bottom) - max(self.top, other.top)
        return max(0.0, width) * max(0.0, height)

    def area(self) -> float:
        return (self.right - self.left) * (self.bottom - self.top)


@dataclass(frozen=True)
class Place:
    """Where a name is written.

    Attributes:
        x, y: a point on the line through its middle.
        anchor: what of it is at x, "start", "middle" or "end", as SVG's `text-anchor`.
        far: whether other names may stand between it and its point.
        box: what it takes up.
    """

    x: float
    y: float
    anchor: str
    far: bool
    box: Box


def label_places(
    points: Sequence[tuple[float, float]], widths: Sequence[float], room: Box, obstacles: Sequence[Box] = ()
) -> list[Place]:
    """A place for each point's name, of the given width, within `room` and off points and obstacles where that goes."""
    marks = [Box(x - _GAP, y - _LINE / 2, x + _GAP, y + _LINE / 2) for x, y in points]
    found: list[Place] = []
    for index, (point, width) in enumerate(zip(points, widths, strict=True)):
        taken = [*(place.box for place in found), *marks[:index], *marks[index + 1 :], *obstacles]
        tried = _around(point, width)
        found.append(min(tried, key=lambda place: _cost(place.box, taken, room)))
    return found


def _around(point: tuple[float, float], width: float) -> list[Place]:
    x, y = point
    lefts = {"start": x + _GAP, "end": x - _GAP - width, "middle": x - width / 2}
    anchors = {"start": x + _GAP, "end": x - _GAP, "middle": x}
    places = []
    for side, line in _PLACES:
        if side == "middle" and line == 0:
            continue  # on the point itself
        middle = y + line * _LINE
        box = Box(lefts[side], middle - _LINE / 2, lefts[side] + width, middle + _LINE / 2)
        places.append(Place(round(anchors[side], 2), round(middle, 2), side, abs(line) > 1, box))
    return places


def _cost(box: Box, taken: Sequence[Box], room: Box) -> float:
    """The area that is covered or outside; at equal cost the earlier place is chosen."""
    return sum(box.shared(other) for other in taken) + 4 * (box.area() - box.shared(room))
