"""What kind of mistake a shadow makes: light where it should be dark or darkness in light, and where.

An error at a shadow's edge, or within its penumbra, is one of resolution and filtering. Away from every edge, darkness
is a surface that shadows itself (acne), and light has leaked through what should block it. Where a surface is touched
by what casts onto it, light is a shadow that has come loose (peter-panning).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from .comparison import Comparison
from .input_error import InputError
from .measurement import Measurement
from .mse import rmse
from .objects import by_object

KINDS = ("lit", "dark")
"""Lit but should be dark; dark but should be lit."""
PLACES = ("edge", "contact", "near", "away")
"""At the true shadow's edge or within its penumbra; where another object touches; not far from an edge; elsewhere."""
UMBRA, FULL = 0.01, 0.99
"""Visible shares of a light between which a point is in the penumbra."""
WRONG = 0.1
"""Share of the light by which a pixel that counts as wrong is off."""


@dataclass(frozen=True)
class ShadowPart:
    """The pixels of one kind of mistake in one place.

    Attributes:
        pixels: how many of them are wrong by more than a tenth of the light that would arrive unshadowed.
        share: of the light's squared error; all parts' add up to 1. NaN where there is no error to share out.
    """

    pixels: int
    share: Measurement


@dataclass(frozen=True)
class ShadowError:
    """One light's shadow against the truth.

    Attributes:
        rmse: over all pixels, in radiance.
        parts: kind, then place, to its part; see `KINDS` and `PLACES`.
    """

    rmse: Measurement
    parts: Mapping[str, Mapping[str, ShadowPart]]


def shadow_error(
    tested: Sequence[np.ndarray],
    shadowed: Sequence[np.ndarray],
    unshadowed: Sequence[np.ndarray],
    shapes: np.ndarray | None = None,
    positions: np.ndarray | None = None,
    *,
    edge: float = 2.0,
    near: float = 8.0,
    metres: bool = False,
    confidence: float = 0.95,
) -> ShadowError:
    """Splits the squared error of a visibility.

    Args:
        tested: one image (H, W, 3) or K: the exact unshadowed radiance times the visibility that is judged.
        shadowed, unshadowed: K independent batches of the exact radiance with and without shadow, A and B.
        shapes: (H, W) integers, which object a pixel shows; edges are then looked for within objects. None: one object.
        positions: (H, W, 3) metres; with `shapes` it tells where objects touch, and distances may be in metres.
        edge, near: up to which distance from the true edge a pixel is at the edge, or near it or near a contact, in
            pixels. Light near a contact counts there, at an edge too: all of a thin caster's shadow is edge.
        metres: `edge` and `near` are in metres, measured straight through space.

    Returns:
        Shares of the squared error, free of the noise's bias: a pixel is sorted by the sign of its mean error, which
        says nothing of how its noise multiplies between batches.

    Raises:
        InputError: sizes or batches differ, distances are wanted in metres without positions, or `edge` > `near`.
    """
    comparison = Comparison(tested, shadowed, confidence=confidence)
    _check(comparison, unshadowed, shapes, positions, edge, near, metres)
    a, b, t = (np.mean(images, axis=0, dtype=np.float64).sum(axis=2) for images in (shadowed, unshadowed, tested))
    arrives = b > 0
    truth = np.where(arrives, a / np.where(arrives, b, 1.0), 1.0)
    error = t - a
    shapes = np.zeros(arrives.shape, np.int32) if shapes is None else shapes
    ruler = _Ruler(positions if metres else None)
    from_edge = ruler.distance(shadow_edge(truth, arrives, shapes))
    touched = np.zeros(arrives.shape, bool) if positions is None else contacts(shapes, positions)
    at_contact = ruler.distance(touched) <= near
    places = np.full(arrives.shape, PLACES.index("away"))
    places[from_edge <= near] = PLACES.index("near")
    places[at_contact] = PLACES.index("contact")
    places[from_edge <= edge] = PLACES.index("edge")
    places[at_contact & (error > 0)] = PLACES.index("contact")
    kinds = np.where(error > 0, 0, 1)
    cells = np.where(error == 0, -1, kinds * len(PLACES) + places)
    found = by_object(comparison, cells)
    wrong = np.abs(error) > WRONG * b
    none = Measurement(0.0, how="no pixel")

    def part(kind: int, place: int) -> ShadowPart:
        cell = kind * len(PLACES) + place
        share = found[cell].share if cell in found else none
        return ShadowPart(int(np.count_nonzero(wrong & (cells == cell))), share)

    parts = {kind: {place: part(k, p) for p, place in enumerate(PLACES)} for k, kind in enumerate(KINDS)}
    return ShadowError(rmse(comparison), parts)


def shadow_edge(truth: np.ndarray, arrives: np.ndarray, shapes: np.ndarray) -> np.ndarray:
    """(H, W) boolean: the penumbra, and both sides of where a visible share crosses one half within an object.

    Args:
        truth: (H, W) the visible share of the light.
        arrives: (H, W) boolean: where light would arrive unshadowed.
        shapes: (H, W) which object is seen.
    """
    found = arrives & (truth > UMBRA) & (truth < FULL)
    for here, there in _neighbours():
        same = arrives[here] & arrives[there] & (shapes[here] == shapes[there])
        crossing = same & ((truth[here] < 0.5) != (truth[there] < 0.5))
        found[here] |= crossing
        found[there] |= crossing
    return found


def contacts(shapes: np.ndarray, positions: np.ndarray) -> np.ndarray:
    """(H, W) boolean: pixels beside another object that is no farther in space than neighbours on one object are.

    Three times as far counts as touching: a surface seen at a slant has its neighbours farther away than another's.
    """
    step = np.full(shapes.shape, np.inf)
    pairs = []
    for here, there in _neighbours():
        apart = np.linalg.norm(positions[here].astype(np.float64) - positions[there], axis=-1)
        both = (shapes[here] >= 0) & (shapes[there] >= 0)
        same = both & (shapes[here] == shapes[there])
        pairs.append((here, there, both & ~same, apart))
        for side in (here, there):
            step[side] = np.minimum(step[side], np.where(same, apart, np.inf))
    found = np.zeros(shapes.shape, bool)
    for here, there, other, apart in pairs:
        reach = 3 * np.fmax(*(np.where(np.isfinite(step[side]), step[side], 0.0) for side in (here, there)))
        touching = other & (apart <= reach)
        found[here] |= touching
        found[there] |= touching
    return found


def _neighbours() -> tuple[tuple[tuple[slice, slice], tuple[slice, slice]], ...]:
    """The two halves of all pairs of pixels beside each other and above each other."""
    whole, first, last = slice(None), slice(None, -1), slice(1, None)
    return ((whole, first), (whole, last)), ((first, whole), (last, whole))


class _Ruler:
    """Distances to the nearest of some pixels, in pixels or, with positions, in metres to that pixel's."""

    def __init__(self, positions: np.ndarray | None) -> None:
        self._positions = positions

    def distance(self, pixels: np.ndarray) -> np.ndarray:
        """(H, W); infinite where there are none."""
        from scipy.ndimage import distance_transform_edt

        if not pixels.any():
            return np.full(pixels.shape, np.inf)
        if self._positions is None:
            return np.asarray(distance_transform_edt(~pixels))
        rows, columns = np.asarray(distance_transform_edt(~pixels, return_distances=False, return_indices=True))
        return np.linalg.norm(self._positions.astype(np.float64) - self._positions[rows, columns], axis=-1)


def _check(comparison, unshadowed, shapes, positions, edge: float, near: float, metres: bool) -> None:
    size = comparison.height, comparison.width
    if len(unshadowed) != comparison.batches or any(image.shape != (*size, 3) for image in unshadowed):
        raise InputError(
            "the unshadowed radiance does not fit the shadowed",
            expected=f"{comparison.batches} images of shape {(*size, 3)}",
            actual=f"{len(unshadowed)} of {sorted({image.shape for image in unshadowed})}",
            remedy="Give A and B of the same batches.",
        )
    for name, array, shape in (("shapes", shapes, size), ("positions", positions, (*size, 3))):
        if array is not None and array.shape != shape:
            raise InputError(
                f"the {name} do not fit the images",
                expected=f"shape {shape}",
                actual=str(array.shape),
                remedy="Give those of the pixels' centres.",
            )
    if metres and positions is None:
        raise InputError(
            "distances in metres need to know where the pixels' points are",
            expected="positions",
            actual="none",
            remedy="Give them, or distances in pixels.",
        )
    if not 0 <= edge <= near:
        raise InputError(
            "the distances from the edge are out of order",
            expected="0 ≤ edge ≤ near",
            actual=f"edge {edge:g}, near {near:g}",
            remedy="What is at the edge is also near it.",
        )
