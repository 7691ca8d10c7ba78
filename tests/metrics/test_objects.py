"""Error per object: each is a comparison of its own pixels, and the shares add up."""

import math
import time

import numpy as np
import pytest

from lightmeter.metrics import Comparison, InputError, measure
from lightmeter.metrics.objects import MOST_BATCHES, by_object

RNG = np.random.default_rng
IDS = np.array([[-1, -1, 0, 0], [-1, 7, 7, 0], [7, 7, 7, 0], [7, 7, 7, 0]])


def batches(k, seed=0, noise=0.1):
    return 0.5 + noise * RNG(seed).normal(size=(k, 4, 4, 3))


def test_an_object_is_its_masked_pixels():
    tested, reference = RNG(1).random((4, 4, 3)), batches(8)
    found = by_object(Comparison(tested, reference, confidence=0.9), IDS)
    assert list(found) == [-1, 0, 7]
    for number, part in found.items():
        mask = number == IDS
        assert part.pixels == mask.sum()
        for name in ("mse", "rmse", "bias"):
            masked = measure(name, tested, reference, mask)
            assert part.metrics[name].value == pytest.approx(masked.value, rel=1e-12)
            assert masked.low < part.metrics[name].low  # 90 % is narrower than 95 %
            assert part.metrics[name].high < masked.high


def test_shares_add_up_to_one_and_are_those_of_the_error():
    # Errors 0.1 on the background's 3 pixels, 0.2 on 5, 0.4 on 8: 0.03 : 0.2 : 1.28.
    truth = np.full((4, 4, 3), 0.5)
    error = np.select([IDS == -1, IDS == 0], [0.1, 0.2], 0.4)[..., None]
    for reference in (truth[None], batches(64, noise=0.01)):
        found = by_object(Comparison(truth + error, reference), IDS)
        assert math.fsum(part.share.value for part in found.values()) == pytest.approx(1, abs=1e-12)
        expected = np.array([0.03, 0.2, 1.28]) / 1.51
        # Noise of a share: 2·σ/(√(K·3·5)·0.2) relative at worst, 0.003.
        assert [part.share.value for part in found.values()] == pytest.approx(expected, rel=0.02)
    for part, share in zip(found.values(), expected, strict=True):
        assert part.share.low < share < part.share.high
    assert by_object(Comparison(truth + error, truth), IDS)[0].share.low is None


def test_interval_of_a_share_covers():
    # 300 trials at K = 8; 12 misses more than the 15 expected have a probability under 1e-3.
    truth = np.full((4, 4, 3), 0.5)
    error = np.select([IDS == -1, IDS == 0], [0.1, 0.2], 0.4)[..., None]
    hits = 0
    for seed in range(300):
        share = by_object(Comparison(truth + error, batches(8, seed)), IDS)[0].share
        hits += share.low <= 0.2 / 1.51 <= share.high
    assert hits >= 273


def test_many_batches_are_averaged_in_groups():
    tested, reference = RNG(1).random((4, 4, 3)), batches(4 * MOST_BATCHES + 3)
    merged = reference[:65].reshape(13, 5, 4, 4, 3).mean(axis=1)  # 67 batches: 13 means of 5
    found = by_object(Comparison(tested, reference), IDS)[7].metrics["mse"]
    assert found == by_object(Comparison(tested, merged), IDS)[7].metrics["mse"]


def test_masked_pixels_belong_to_no_object():
    tested, reference = RNG(1).random((4, 4, 3)), batches(8)
    mask = IDS != 0
    mask[1, 1] = False
    found = by_object(Comparison(tested, reference, mask), IDS)
    assert {number: part.pixels for number, part in found.items()} == {-1: 3, 7: 7}


def test_both_sides_may_be_noisy():
    found = by_object(Comparison(batches(8, 1) + (IDS == 7)[..., None], batches(8, 2)), IDS)
    assert found[7].share.value == pytest.approx(1, abs=0.05)
    assert found[7].metrics["bias"].value == pytest.approx(1, abs=0.1)


def test_non_finite_pixels_fail_their_object_only():
    tested = np.full((4, 4, 3), 0.6)
    tested[0, 0] = np.nan
    found = by_object(Comparison(tested, batches(8)), IDS)
    assert math.isnan(found[-1].metrics["mse"].value)
    assert found[0].metrics["bias"].value == pytest.approx(0.1, abs=0.05)
    assert math.isnan(found[0].share.value)


def test_no_error_has_no_shares():
    reference = np.repeat(batches(1), 8, axis=0)
    found = by_object(Comparison(reference[0], reference), IDS)
    assert math.isnan(found[0].share.value)
    assert "within its noise" in found[0].share.how


def test_flip_of_an_object_is_its_mean():
    flip_map = RNG(3).random((4, 4)).astype(np.float32)
    found = by_object(Comparison(np.zeros((4, 4, 3)), batches(8)), IDS, flip_map)
    assert found[7].metrics["flip"].value == pytest.approx(flip_map[IDS == 7].mean(), rel=1e-6)


def test_thousands_of_objects_cost_in_proportion():
    # 1,024 objects of 16 pixels against 128 of 128: eight times the walk over objects, the same pixels. A mask per
    # object would look at eight times the pixels and do eight times the work for each.
    reference = RNG(0).random((8, 128, 128, 3)).astype(np.float32)
    comparison = Comparison(reference[0] + 1, reference)
    rows, columns = np.indices((128, 128))
    times = []
    for height in (4, 32):
        start = time.process_time()
        by_object(comparison, rows // height * 32 + columns // 4)
        times.append(time.process_time() - start)
    assert times[0] < 16 * times[1]


@pytest.mark.parametrize("ids", [IDS[:3], IDS.astype(float)])
def test_ids_are_checked(ids):
    with pytest.raises(InputError, match=r"object ids do not fit.*integers of shape \(4, 4\)"):
        by_object(Comparison(np.zeros((4, 4, 3)), batches(8)), ids)
    with pytest.raises(InputError, match="FLIP map does not fit"):
        by_object(Comparison(np.zeros((4, 4, 3)), batches(8)), IDS, np.zeros((3, 3)))
