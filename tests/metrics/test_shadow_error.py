"""Mistakes of shadows, planted one by one: each is found where it is, of the kind that it is."""

import numpy as np
import pytest

from lightmeter.metrics.input_error import InputError
from lightmeter.metrics.shadow_error import KINDS, PLACES, shadow_error

SIDE = 64
COLUMN, ROW = np.meshgrid(np.arange(SIDE), np.arange(SIDE))
TRUTH = (COLUMN >= 32).astype(np.float64)  # dark on the left
SHAPES = np.where(ROW < 8, 1, 0)  # a wall above, standing on the floor
FLOOR = np.stack([COLUMN * 0.1, 0 * ROW, ROW * 0.1], axis=-1)
POSITIONS = np.where((ROW < 8)[..., None], np.stack([COLUMN * 0.1, (8 - ROW) * 0.1, 0.7 + 0 * ROW], axis=-1), FLOOR)
RADIANCE = np.array([0.5, 0.4, 0.3])


def image(values) -> np.ndarray:
    """A visibility as radiance."""
    return (values[..., None] * RADIANCE).astype(np.float32)


def split(tested, truth=TRUTH, noise=0.0, batches=8, **options):
    """The error's parts, with every other than the whole and its parts left out."""
    rng = np.random.default_rng(1)
    unshadowed = [image(1 + noise * rng.normal(size=truth.shape)) for _ in range(batches)]
    shadowed = [b * truth[..., None].astype(np.float32) for b in unshadowed]
    judged = [b * tested[..., None].astype(np.float32) for b in unshadowed]
    given = {"shapes": SHAPES, "positions": POSITIONS} | options
    return shadow_error(judged, shadowed, unshadowed, **given)


def shares(found) -> dict[tuple[str, str], float]:
    """The parts that hold more than a thousandth of the error."""
    parts = {(kind, place): found.parts[kind][place].share.value for kind in KINDS for place in PLACES}
    assert sum(parts.values()) == pytest.approx(1)
    return {cell: share for cell, share in parts.items() if share > 1e-3}


def changed(where, value) -> np.ndarray:
    """The truth with another visibility at some pixels."""
    return np.where(where, value, TRUTH)


SPOTS = (COLUMN % 5 == 0) & (ROW % 3 == 0) & (ROW > 20)
PLANTED = {
    "acne": (changed(SPOTS & (COLUMN > 45), 0.0), ("dark", "away")),
    "a leak": (changed(SPOTS & (COLUMN < 20), 0.3), ("lit", "away")),
    "an edge one pixel to the right": (changed(COLUMN == 32, 0.0), ("dark", "edge")),
    "an edge one pixel to the left": (changed((COLUMN == 31) & (ROW > 20), 1.0), ("lit", "edge")),
    "a filter's spill": (changed((COLUMN > 35) & (COLUMN < 39) & (ROW > 20), 0.8), ("dark", "near")),
    "a shadow come loose": (changed((ROW > 7) & (ROW < 11) & (COLUMN < 32), 1.0), ("lit", "contact")),
    "a dark corner": (changed((ROW > 7) & (ROW < 11) & (COLUMN > 45), 0.5), ("dark", "contact")),
}


@pytest.mark.parametrize("name", PLANTED)
def test_a_planted_mistake_is_found(name):
    tested, (kind, place) = PLANTED[name]
    found = split(tested)
    assert shares(found) == {(kind, place): pytest.approx(1)}
    assert found.parts[kind][place].pixels == np.count_nonzero(np.abs(tested - TRUTH) > 0.1 + 1e-6)
    expected = np.sqrt(np.mean((image(tested - TRUTH)) ** 2))
    assert found.rmse.value == pytest.approx(expected, rel=1e-5)


def test_several_mistakes_share_the_squared_error():
    """32 pixels off by all of the light and 128 off by half of it: equal shares."""
    tested = changed((COLUMN == 32) & (ROW >= 32), 0.0)
    tested = np.where((COLUMN < 4) & (ROW >= 32), 0.5, tested)
    assert shares(split(tested)) == {("dark", "edge"): pytest.approx(0.5), ("lit", "away"): pytest.approx(0.5)}


def test_within_a_penumbra_everything_is_at_the_edge():
    ramp = np.clip((COLUMN - 12) / 40, 0, 1)
    found = split((ramp > 0.5).astype(float), ramp, positions=None)
    assert set(shares(found)) == {("lit", "edge"), ("dark", "edge")}


def test_distances_may_be_in_metres():
    """A tenth of a metre a pixel on the floor; straight through space from a wall's foot."""
    tested = changed((COLUMN == 37) & (ROW > 20), 0.0)
    assert set(shares(split(tested))) == {("dark", "near")}
    assert set(shares(split(tested, edge=0.2, near=0.8, metres=True))) == {("dark", "near")}
    assert set(shares(split(tested, edge=0.2, near=0.4, metres=True))) == {("dark", "away")}
    assert set(shares(split(tested, edge=0.6, near=0.8, metres=True))) == {("dark", "edge")}


def test_an_object_s_outline_is_neither_an_edge_nor_a_contact():
    """Something lit in front of a dark floor, far from it in space."""
    before = (ROW > 30) & (ROW < 50) & (COLUMN < 20)
    truth = np.where(before, 1.0, TRUTH)
    shapes = np.where(before, 2, SHAPES)
    positions = np.where(before[..., None], POSITIONS + np.array([0, 3.0, 0]), POSITIONS)
    beside = (ROW > 30) & (ROW < 50) & (COLUMN == 20)
    found = split(np.where(beside, 1.0, truth), truth, shapes=shapes, positions=positions)
    assert set(shares(found)) == {("lit", "away")}
    # As one object it would have an edge there.
    found = split(np.where(beside, 1.0, truth), truth, shapes=np.zeros_like(shapes), positions=positions)
    assert set(shares(found)) == {("lit", "edge")}


def test_without_positions_nothing_touches():
    tested, _ = PLANTED["a shadow come loose"]
    assert set(shares(split(tested, positions=None))) == {("lit", place) for place in ("edge", "near", "away")}


def test_noise_has_no_share():
    """A truth of few samples in the penumbra: both kinds of its noise are alike, and neither is an error.

    Every batch draws 4 samples a pixel. What is tested is the true visibility but for an edge; its share is all of the
    error, within what the intervals of the others say.
    """
    rng = np.random.default_rng(3)
    ramp = np.clip((COLUMN - 12) / 40, 0, 1)
    tested = np.where(COLUMN < 4, 0.5, ramp)
    unshadowed = [image(np.ones_like(ramp)) for _ in range(16)]
    shadowed = [image(rng.binomial(4, ramp) / 4) for _ in range(16)]
    found = shadow_error([image(tested)], shadowed, unshadowed)
    assert found.parts["lit"]["away"].share.value == pytest.approx(1, abs=0.02)
    for kind in KINDS:
        noise = found.parts[kind]["edge"].share
        assert noise.low <= 0 <= noise.high and abs(noise.value) < 0.02


def test_no_error_and_no_light():
    found = split(TRUTH)
    assert found.rmse.value == 0
    assert all(part.pixels == 0 for places in found.parts.values() for part in places.values())
    dark = np.zeros((SIDE, SIDE, 3), np.float32)
    assert shadow_error([dark], [dark], [dark]).rmse.value == 0


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"shapes": SHAPES[1:]}, "the shapes do not fit"),
        ({"positions": POSITIONS[1:]}, "the positions do not fit"),
        ({"positions": None, "metres": True}, "positions, got none"),
        ({"edge": 9.0}, "edge ≤ near, got edge 9, near 8"),
    ],
)
def test_what_does_not_fit_is_told(options, message):
    with pytest.raises(InputError, match=message):
        split(TRUTH, **options)
    with pytest.raises(InputError, match="A and B of the same batches"):
        shadow_error([image(TRUTH)], [image(TRUTH)] * 8, [image(TRUTH)] * 7)
