"""Transfer and exposure: named where levels and contrasts agree on them, and not where a light is missing.

A factor comes out of a histogram with bins of 0.5 % and of levels that agree to 10 %; noise of 15 % over 8 batches and
the blur leaves the levels 2 % each, of which there are thousands. So 1 % of a factor where everything agrees.
"""

import numpy as np
import pytest

from lightmeter.metrics.registration import correct, find_faults
from lightmeter.metrics.registration.curves import srgb_decode, srgb_encode

from .pictures import Lighting, noisy, picture

SIDE = 64
FACTOR = 0.01


def found(tested, seed=0, **options):
    return find_faults(np.asarray(tested, np.float32), noisy(picture(SIDE), seed), **options)


def names(faults):
    return tuple(fault.name for fault in faults)


@pytest.mark.parametrize("factor", [1.5, 0.8, 1.2, 16, 0.1])
def test_an_exposure_is_named_with_its_factor(factor):
    (fault,) = found(factor * picture(SIDE))
    assert fault.name == "exposure"
    assert fault.size["factor"] == pytest.approx(factor, rel=FACTOR)
    assert (
        f"× {fault.size['factor']:.3g}" in fault.words and f"{np.log2(fault.size['factor']):+.2f} stops" in fault.words
    )


def test_an_exposure_that_ambient_light_could_make_is_not_named():
    assert found(1.08 * picture(SIDE)) == ()


@pytest.mark.parametrize(
    "lighting",
    [
        Lighting(ambient=0),
        Lighting(ambient=0, shadows=False),
        Lighting(shadows=False),
        Lighting(ambient=0.5),
        Lighting(sun=0.6),
        Lighting(where=(0.5, 0.5)),
    ],
)
def test_another_light_is_no_exposure(lighting):
    tested = picture(SIDE, lighting=lighting)
    assert found(tested) == ()


def test_missing_ambient_light_is_no_exposure_even_where_levels_agree():
    """Under an even sun a missing ambient term lowers every level alike; the contrast that shadows make stays."""
    far = (0.0, -30.0)  # so far that its light is the same everywhere
    truth = picture(SIDE, lighting=Lighting(sun=900, where=far))
    tested = picture(SIDE, lighting=Lighting(sun=900, ambient=0, where=far))
    lit = truth.mean(axis=2) > 0.5 * np.median(truth.mean(axis=2))
    ratios = (tested / truth).mean(axis=2)[lit]
    assert np.percentile(ratios, 90) / np.percentile(ratios, 40) < 1.05  # a factor that most of the picture agrees on
    assert np.median(ratios) < 0.8
    assert find_faults(tested.astype(np.float32), noisy(truth)) == ()


def test_an_exposed_frame_with_light_of_its_own_is_found_all_the_same():
    (fault,) = found(1.5 * picture(SIDE, lighting=Lighting(ambient=0.25)))
    assert fault.name == "exposure"
    # Of 0.3 + 0.3 to 0.3 + 1 of light 0.05 is lacking: most levels are lower by 4 to 8 %.
    assert 1.5 * (1 - 0.05 / 0.6) < fault.size["factor"] < 1.5 * (1 - 0.05 / 1.3)


@pytest.mark.parametrize(
    "curve, exponent, srgb",
    [
        (srgb_encode, 1 / 2.2, 1),
        (lambda x: srgb_encode(np.clip(x, 0, 1)), 1 / 2.2, 1),
        (srgb_decode, 2.2, 1),
        (lambda x: x ** (1 / 2.2), 1 / 2.2, None),  # hardly to be told from the sRGB curve
        (lambda x: x**2.2, 2.2, None),
    ],
)
def test_a_transfer_is_named_with_its_exponent(curve, exponent, srgb):
    (fault,) = found(curve(picture(SIDE)))
    assert fault.name == "transfer"
    # A power law's exponent is that of the levels, which agree to 5 % over a range of about 20 : 1.
    assert fault.size["exponent"] == pytest.approx(exponent, rel=0.05 / np.log(20) * 5)
    assert srgb is None or fault.size["srgb"] == srgb
    assert f"exponent {fault.size['exponent']:.2f}" in fault.words


def test_a_transfer_and_an_exposure_are_told_apart():
    faults = found(srgb_encode(1.5 * picture(SIDE)))
    assert names(faults) == ("transfer", "exposure")
    assert faults[1].size["factor"] == pytest.approx(1.5, rel=2 * FACTOR)


def test_linear_where_display_values_were_promised():
    truth = srgb_encode(np.clip(picture(SIDE), 0, 1))
    batches = np.clip(srgb_encode(noisy(picture(SIDE))), 0, 1)
    assert find_faults(truth.astype(np.float32), batches, display=True) == ()
    (fault,) = find_faults(picture(SIDE).astype(np.float32), batches, display=True)
    assert fault.name == "transfer" and fault.size["exponent"] == 2.2
    assert fault.words == "linear, where display values were promised (sRGB curve, exponent 2.20)"
    (fault,) = find_faults(srgb_encode(truth).astype(np.float32), batches, display=True)
    assert fault.name == "transfer" and fault.words.startswith("encoded twice")


def test_an_exposure_of_display_values_is_one_of_light():
    batches = srgb_encode(noisy(0.4 * picture(SIDE)))
    tested = srgb_encode(1.5 * 0.4 * picture(SIDE)).astype(np.float32)
    (fault,) = find_faults(tested, batches, display=True)
    assert fault.size["factor"] == pytest.approx(1.5, rel=FACTOR)
    assert correct(tested, [fault]) == pytest.approx(srgb_encode(0.4 * picture(SIDE)), abs=FACTOR)


def test_an_encoded_frame_that_agrees_on_nothing_is_still_named():
    """Light that is up to twice too strong here and too weak there shares no factor; encoding brightens all of it."""
    waves = np.sin(np.arange(SIDE) / 6)
    truth = 0.15 * picture(SIDE)
    tested = truth * 2 ** (waves[None, :, None] * waves[:, None, None])
    assert find_faults(tested.astype(np.float32), noisy(truth)) == ()
    (fault,) = find_faults(srgb_encode(tested).astype(np.float32), noisy(truth))
    assert fault.name == "transfer" and fault.size == {"exponent": 1 / 2.2, "srgb": 1.0}
    # Too bright by an exposure, it is not called encoded.
    assert "transfer" not in names(find_faults((4 * tested).astype(np.float32), noisy(truth)))


def test_curves_invert_each_other():
    values = np.geomspace(1e-4, 50, 200)
    assert srgb_decode(srgb_encode(values)) == pytest.approx(values, rel=1e-6)
    assert srgb_encode(np.array([0.0, 0.0031308, 1.0])) == pytest.approx([0, 0.04045, 1], abs=1e-5)  # IEC 61966-2-1
