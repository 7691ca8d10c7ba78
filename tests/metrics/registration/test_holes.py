"""Alpha and background: pixels that lack what the truth shows."""

import numpy as np
import pytest

from lightmeter.metrics.registration import correct, find_faults

from .pictures import noisy, picture

SIDE = 64
SKY = np.array([0.3, 0.4, 0.6])


def covered():
    """(SIDE, SIDE): how much of a pixel a big disc covers, over the sky."""
    steps = (np.arange(SIDE * 8) + 0.5) / 8 - SIDE / 2
    inside = steps[None] ** 2 + steps[:, None] ** 2 < (0.4 * SIDE) ** 2
    return inside.reshape(SIDE, 8, SIDE, 8).mean(axis=(1, 3))


def seen(sky=SKY):
    """The picture on the disc, the sky around it."""
    share = covered()[..., None]
    return share * picture(SIDE) + (1 - share) * sky


def background():
    """Pixels whose centre sees no surface."""
    return covered() < 0.5


def found(tested, **options):
    return find_faults(np.asarray(tested, np.float32), noisy(seen()), background=background(), **options)


def veil():
    """An alpha of 0.4 in a quarter of the picture."""
    alpha = np.ones((SIDE, SIDE))
    alpha[10:42, 10:42] = 0.4
    return alpha


def test_the_right_frame_has_neither():
    assert found(seen()) == ()
    assert found(seen(), alpha=covered()) == ()
    assert found(seen(), alpha=veil()) == ()


def test_colours_multiplied_by_alpha_are_counted():
    tested = seen() * veil()[..., None]
    (fault,) = found(tested, alpha=veil())
    assert fault.name == "alpha"
    assert fault.size == {"pixels": 32 * 32, "lost": 0}
    assert fault.words == "colours are multiplied by alpha at 1024 pixels"
    corrected = correct(tested.astype(np.float32), [fault], alpha=veil())
    assert corrected == pytest.approx(seen(), rel=1e-6)


def test_what_alpha_took_wholly_is_lost():
    tested, alpha = seen() * covered()[..., None], covered()
    (fault,) = found(tested, alpha=alpha)
    assert fault.name == "alpha"
    assert fault.size == {"pixels": np.count_nonzero(alpha < 0.98), "lost": np.count_nonzero(alpha == 0)}
    corrected = correct(tested.astype(np.float32), [fault], alpha=alpha)
    there = alpha > 0
    assert corrected[there] == pytest.approx(seen()[there], rel=1e-5)
    assert not corrected[~there].any()
    # What is black then is the background, and nothing else is wrong any more.
    (rest,) = found(corrected, alpha=alpha)
    assert rest.name == "background" and rest.size["pixels"] == np.count_nonzero(alpha == 0)


def test_surfaces_without_alpha_are_lost():
    alpha = np.where(veil() < 1, 0.0, 1.0)
    (fault,) = found(seen() * alpha[..., None], alpha=alpha)
    lost = np.count_nonzero((alpha == 0) & ~background())
    assert fault.name == "alpha" and fault.size == {"pixels": lost, "lost": lost}


def test_a_black_background_is_missing():
    (fault,) = found(np.where(background()[..., None], 0.0, seen()))
    assert fault.name == "background"
    assert fault.size == {"pixels": np.count_nonzero(background())}
    assert fault.words == f"the background is black at {np.count_nonzero(background())} pixels"


def test_a_frame_over_nothing_misses_its_background_and_has_no_fault_of_alpha():
    """What OpenEXR calls associated alpha: right where surfaces cover, and without what is behind them."""
    tested = covered()[..., None] * picture(SIDE)
    (fault,) = found(tested, alpha=covered())
    # Partly covered pixels are neither black nor as the truth: they are not counted.
    assert fault.name == "background" and fault.size["pixels"] == np.count_nonzero(covered() == 0)


def test_another_background_is_described():
    grey = np.where(background()[..., None], [0.2, 0.2, 0.2], seen())
    (fault,) = found(grey)
    assert fault.name == "background" and "one colour, (0.2, 0.2, 0.2)" in fault.words
    brighter = np.where(background()[..., None], 2 * SKY, seen())
    (fault,) = found(brighter)
    assert fault.name == "background" and "× 2 as bright as the truth's" in fault.words


def test_a_background_that_shares_the_exposure_is_not_missing():
    (fault,) = found(1.5 * seen())
    assert fault.name == "exposure"


def test_an_exposed_frame_without_background_lacks_both():
    exposure, missing = found(np.where(background()[..., None], 0.0, 1.5 * seen()))
    assert exposure.name == "exposure" and exposure.size["factor"] == pytest.approx(1.5, rel=0.01)  # as in test_light
    assert missing.name == "background"


def test_where_the_truth_shows_nothing_nothing_is_missing():
    dark = noisy(seen(np.zeros(3)))
    assert find_faults(seen(np.zeros(3)).astype(np.float32), dark, background=background()) == ()


def test_without_a_mask_no_background_is_missed():
    tested = np.where(background()[..., None], 0.0, seen())
    assert find_faults(tested.astype(np.float32), noisy(seen())) == ()


def test_mirrored_alpha_goes_with_its_image():
    tested = (seen() * veil()[..., None])[:, ::-1]
    faults = found(tested, alpha=veil()[:, ::-1])
    assert [fault.name for fault in faults] == ["flip", "alpha"]
    corrected = correct(tested.astype(np.float32), faults, alpha=veil()[:, ::-1])
    assert corrected == pytest.approx(seen(), rel=1e-6)
