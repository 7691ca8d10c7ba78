"""Shift and field of view, planted exactly into pictures that are known at every point.

Tolerances: the reference's noise leaves a standard error of about 0.01 pixels (8 batches of 15 % noise over some 300
pixels' length of edges at 64²; the jackknife gives the same), and edges of a box-filtered picture are off by up to 0.02
pixels where the logarithm bends them. So 0.06 pixels, four errors and the bend; a scale has the same at the border, of
32 pixels 0.19 %. Larger scales are underestimated by up to 1 % of their size by the same bend.
"""

import numpy as np
import pytest

from lightmeter.metrics.registration import correct, find_faults, outside

from .pictures import Lighting, noisy, picture

SIDE = 64
PIXELS = 0.06
PERCENT = 100 * PIXELS / (SIDE / 2)


def names(faults):
    return tuple(fault.name for fault in faults)


def found(tested, seed=0, **options):
    return find_faults(tested.astype(np.float32), noisy(picture(SIDE), seed), **options)


@pytest.mark.parametrize("right, down", [(0.5, 0), (0, -0.5), (0.5, 0.5), (-3.25, 1.75), (5, -7)])
def test_a_shift_is_named_with_its_size(right, down):
    (fault,) = found(picture(SIDE, right=right, down=down))
    assert fault.name == "shift"
    assert fault.size == pytest.approx({"right": right, "down": down}, abs=PIXELS)


def test_a_shift_in_words():
    (fault,) = found(picture(SIDE, right=0.5, down=-0.5))
    right, up = fault.size["right"], -fault.size["down"]
    assert fault.words == f"shifted by {right:.2f} pixels right and {up:.2f} up"
    (fault,) = found(picture(SIDE, right=-3.25, down=1.75))
    assert fault.words == f"shifted by {-fault.size['right']:.2f} pixels left and {fault.size['down']:.2f} down"


@pytest.mark.parametrize("scale", [0.98, 1.02, 1.1, 0.85])
def test_a_field_of_view_is_named_in_per_cent_of_the_tangent(scale):
    (fault,) = found(picture(SIDE, across=scale, upright=scale))
    percent = 100 * (scale - 1)
    assert fault.name == "field_of_view"
    expected = {"horizontal": percent, "vertical": percent}
    assert fault.size == pytest.approx(expected, abs=PERCENT + 0.01 * abs(percent))
    assert f"{abs(fault.size['vertical']):.1f} % {'more' if scale > 1 else 'less'}" in fault.words


@pytest.mark.parametrize("across, upright", [(1.03, 1), (1, 0.96), (1.33, 1)])
def test_another_aspect_is_a_field_of_view_that_differs_by_direction(across, upright):
    (fault,) = found(picture(SIDE, across=across, upright=upright))
    assert fault.name == "field_of_view"
    horizontal, vertical = 100 * (across - 1), 100 * (upright - 1)
    tolerance = PERCENT + 0.01 * max(abs(horizontal), abs(vertical))
    assert fault.size == pytest.approx({"horizontal": horizontal, "vertical": vertical}, abs=tolerance)
    assert "another aspect" in fault.words


def test_shift_and_field_of_view_together():
    faults = found(picture(SIDE, right=1, down=-0.75, across=1.03, upright=1.03))
    assert names(faults) == ("shift", "field_of_view")
    assert faults[0].size == pytest.approx({"right": 1, "down": -0.75}, abs=PIXELS)
    assert faults[1].size == pytest.approx({"horizontal": 3, "vertical": 3}, abs=PERCENT + 0.03)


def test_less_than_matters_is_not_named():
    assert found(picture(SIDE, right=0.25)) == ()  # half a pixel is what matters
    assert found(picture(SIDE, across=1.01, upright=1.01)) == ()  # 0.32 pixels at the border


@pytest.mark.parametrize(
    "lighting",
    [
        Lighting(shadows=False),
        Lighting(ambient=0),
        Lighting(ambient=0, shadows=False),
        Lighting(sun=0),
        Lighting(where=(0.6, 0.4)),
    ],
)
@pytest.mark.parametrize("right", [0, 1])
def test_other_light_moves_no_edge(lighting, right):
    """What shading gets wrong is the metrics' business; that a picture lies as it should is not.

    Shadows that are missing on one side of everything pull by the sixth of a pixel, which is less than half of what is
    named (0.4 pixels).
    """
    faults = [f for f in found(picture(SIDE, right=right, lighting=lighting)) if f.name in ("shift", "field_of_view")]
    assert names(faults) == (("shift",) if right else ())
    if faults:
        assert faults[0].size == pytest.approx({"right": right, "down": 0}, abs=0.2)


def test_one_object_in_another_place_is_no_shift():
    """A shift must be agreed on by the whole picture."""
    assert found(picture(SIDE, moved=3)) == ()


def test_an_image_without_edges_cannot_tell():
    x = np.linspace(0, 1, SIDE)
    smooth = 0.2 + 0.3 * x[None, :, None] + 0.2 * x[:, None, None] * np.ones(3)
    shifted = smooth - 0.3 * 2 / SIDE
    assert find_faults(shifted.astype(np.float32), noisy(smooth)) == ()


def test_stripes_tell_one_direction_only():
    rows = np.where(np.arange(SIDE * 8) // 60 % 2, 0.8, 0.2)

    def stripes(down):
        moved = np.roll(rows, round(8 * down)).reshape(SIDE, 8).mean(axis=1)
        return np.broadcast_to(moved[:, None, None], (SIDE, SIDE, 3))

    (fault,) = find_faults(stripes(1).astype(np.float32), noisy(stripes(0)))
    assert fault.size == pytest.approx({"right": 0, "down": 1}, abs=PIXELS)
    assert fault.words.endswith("down") and "right" not in fault.words


def test_a_field_of_view_of_a_wide_image_is_one():
    truth, tested = picture(SIDE)[:40], picture(SIDE, across=1.04, upright=1.04)[:40]
    # The rows that are left are not about the picture's centre: seeing more is a shift as well.
    faults = find_faults(tested.astype(np.float32), noisy(truth))
    assert names(faults) == ("shift", "field_of_view")
    assert faults[1].size == pytest.approx({"horizontal": 4, "vertical": 4}, abs=PERCENT + 0.04)
    # The centre of 40 rows lies 12 above that of 64: there 4 % are 12 − 12 / 1.04 = 0.46 pixels down.
    assert faults[0].size == pytest.approx({"right": 0, "down": 12 - 12 / 1.04}, abs=PIXELS)


@pytest.mark.parametrize("move", [{"right": 1.5, "down": -2}, {"across": 1.05, "upright": 1.05}, {"across": 0.9}])
def test_correcting_lays_the_image_back(move):
    moved = picture(SIDE, **move).astype(np.float32)
    faults = found(moved)
    back = correct(moved, faults)
    there = ~outside(faults, back.shape)
    before, after = (np.sqrt(np.mean((image - picture(SIDE))[there] ** 2)) for image in (moved, back))
    # A picture of steps cannot be resampled without loss; of the error of such a move it is a third.
    assert after < before / 3
    assert find_faults(back, noisy(picture(SIDE))) == ()


def test_outside_is_what_the_frame_does_not_hold():
    (fault,) = found(picture(SIDE, right=2))
    # Content lies 2 pixels right: the last 2 columns of the truth are not in the frame.
    assert outside([fault], (SIDE, SIDE, 3)).sum(axis=0).tolist() == [0] * (SIDE - 2) + [SIDE] * 2
    assert not outside([], (SIDE, SIDE)).any()
