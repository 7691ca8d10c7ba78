import numpy as np
import pytest
from PIL import Image

from lightmeter.reports.heatmap import MASKED, colour_map, colourise, ticks, write_heatmap
from lightmeter.reports.pictures import ErrorMap, Pair, flip_error, rms_error, share_map, signed_error


def test_colours_run_from_the_first_to_the_last() -> None:
    magma = colour_map("magma")
    picture = colourise(np.array([[-1.0, 0.0, 0.5, 1.0, 9.0]]), magma, 0.0, 1.0)
    assert picture[0].tolist() == [magma.rgb[index].tolist() for index in (0, 0, 128, 255, 255)]


def test_magnitude_map_gets_lighter_all_the_way() -> None:
    """What makes it readable in grey and for colour-blind eyes: luma never falls."""
    for name in ("magma", "viridis"):
        luma = colour_map(name).rgb @ np.array([0.2126, 0.7152, 0.0722])
        assert (np.diff(luma) > -1.0).all()
        assert luma[-1] - luma[0] > 150


def test_pixels_that_are_not_finite_have_a_colour_that_no_value_has() -> None:
    for name in ("magma", "vik"):
        colours = colour_map(name)
        distance = np.abs(colours.rgb.astype(int) - colours.nonfinite).sum(axis=1)
        assert distance.min() > 60
        picture = colourise(np.array([[np.nan, np.inf, -np.inf]]), colours, 0.0, 1.0)
        assert (picture == colours.nonfinite).all()


def test_range_rules() -> None:
    values = np.zeros((100, 100), np.float32)
    values[:2] = 3.0
    assert ErrorMap("e", "e", values).range() == (0.0, 3.0)
    values[:2] = 0.0
    values[0, 0] = 7.0  # thinner than one percent: the maximum, not an empty range
    assert ErrorMap("e", "e", values).range() == (0.0, 7.0)
    assert ErrorMap("e", "e", -values, scale="signed").range() == (-7.0, 7.0)
    assert ErrorMap("e", "e", 0 * values).range() == (0.0, 1.0)
    assert ErrorMap("e", "e", np.full((2, 2), np.nan)).range() == (0.0, 1.0)
    assert flip_error(values).range() == (0.0, 1.0)


def test_png_holds_the_pixels_unblended_and_a_bar(tmp_path) -> None:
    values = np.linspace(0, 1, 400, dtype=np.float32).reshape(20, 20)
    values[3, 4] = np.nan
    mask = np.ones((20, 20), bool)
    mask[5, 6] = False
    path = write_heatmap(tmp_path / "h.png", flip_error(values), "title <b>", mask=mask)
    sheet = np.asarray(Image.open(path))
    magma = colour_map("magma")
    centre = sheet[40 + 8 :: 16, 16 + 8 :: 16][:20, :20]  # 20 pixels enlarged by 16
    assert centre[3, 4].tolist() == list(magma.nonfinite)
    assert centre[5, 6].tolist() == list(MASKED)
    assert centre[0, 0].tolist() == magma.rgb[0].tolist()
    assert centre[19, 19].tolist() == magma.rgb[255].tolist()
    bar = sheet[40 + 320 + 20, 16 : 16 + 320]
    assert bar[0].tolist() == magma.rgb[0].tolist()
    assert bar[-1].tolist() == magma.rgb[255].tolist()
    assert [item.name for item in tmp_path.iterdir()] == ["h.png"]


def test_share_map_has_0_in_the_middle_of_its_bar(tmp_path) -> None:
    values = np.zeros((40, 400), np.float32)
    values[:20] = [-3.0] * 390 + [5.0] * 10
    share = share_map("mse", values, "(W/sr/m²)²")
    assert (share.name, share.title) == ("share_mse", "Share of the frame's squared error")
    assert share.range() == (-5.0, 5.0)
    sheet = np.asarray(Image.open(write_heatmap(tmp_path / "h.png", share)))
    vik = colour_map("vik").rgb
    picture, bar = sheet[40 : 40 + 40, 16 : 16 + 400], sheet[40 + 40 + 20, 16 : 16 + 400]
    assert picture[30, 0].tolist() == bar[200].tolist() == vik[128].tolist()
    assert picture[0, 395].tolist() == bar[399].tolist() == vik[255].tolist()
    # −3 of ±5 is a fifth of the way along the bar, on the blue side.
    assert picture[0, 0].tolist() == vik[int(0.2 * 256)].tolist()
    assert vik[51][2] > vik[51][0]


@pytest.mark.parametrize("limits", [(0.0, 1.0), (-3e-7, 3e-7), (0.0, 4.7e5), (0.0, 0.0), (0.0, float("nan"))])
def test_ticks_lie_within(limits: tuple[float, float]) -> None:
    found = ticks(*limits)
    assert len(found) <= 8
    assert all(limits[0] - 1e-12 <= value <= limits[1] * (1 + 1e-9) for value in found)


def test_error_maps_between_pictures() -> None:
    tested, truth = np.zeros((2, 2, 3)), np.zeros((2, 2, 3))
    tested[0, 0] = [3.0, 0.0, 0.0]
    assert rms_error(tested, truth).values[0, 0] == pytest.approx(3**0.5)
    assert signed_error(tested, truth).values[0, 0] == pytest.approx(1.0)


def test_a_pair_of_unequal_sizes_is_refused() -> None:
    small, large = np.zeros((2, 2, 3)), np.zeros((2, 3, 3))
    with pytest.raises(ValueError, match="tested is"):
        Pair("p", "p", (), small, large, (rms_error(small, small),))
    with pytest.raises(ValueError, match="at least one error map"):
        Pair("p", "p", (), small, small, ())
