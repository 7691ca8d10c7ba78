import io
import math
import xml.etree.ElementTree as ET

import pytest
from rich.console import Console

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.closure import closure_statement
from lightmeter.reports.junit import to_junit, write_junit
from lightmeter.reports.results import Closure, Frame, LeftOut, Results
from lightmeter.reports.significant import show_measurement, show_number
from lightmeter.reports.terminal import comparison, metric_table
from lightmeter.reports.verdict import Verdict

from .synthetic_pairs import make_results


@pytest.mark.parametrize(
    ("measurement", "shown"),
    [
        (Measurement(0.012341, 0.01209, 0.01259), "0.01234 ± 0.00025"),
        (Measurement(0.0123, 0.0119, 0.0131, "W"), "0.01230 (0.01190 … 0.01310) W"),
        (Measurement(-1e-4, -4e-4, 2e-4), "−0.00010 ± 0.00030"),
        (Measurement(1e-9, -1e-4, 1e-4), "0.00000 ± 0.00010"),
        (Measurement(12345.6, 12000, 12691.2), "12350 ± 350"),
        (Measurement(0.5), "0.500"),
        (Measurement(1.2e-12), "1.20e−12"),
        (Measurement(math.nan, 0, 1), "NaN"),
        (Measurement(0, 0, 0), "0 ± 0"),
        (Measurement(1.0, -math.inf, 2.0), "1.00 (−∞ … 2.00)"),
        (Measurement(0.0721, 0.0652, 0.0705), "0.0721 (0.0652 … 0.0705)"),  # a bound without the value's noise
        (Measurement(0.5, 0.4, 0.4), "0.500 (0.400000 … 0.400000)"),
        (Measurement(0.003, 0.0, 0.3), "0.00 (0.00 … 0.30)"),
    ],
)
def test_digits_follow_the_interval(measurement: Measurement, shown: str) -> None:
    assert show_measurement(measurement) == shown


def test_infinite_numbers_have_a_sign() -> None:
    assert [show_number(value) for value in (math.inf, -math.inf, 0.0)] == ["∞", "−∞", "0"]


@pytest.mark.parametrize(
    ("bias", "verdict"),
    [
        (Measurement(-1e-4, -4e-4, 2e-4), "meets"),
        (Measurement(1e-3, -4e-3, 6e-3), "wide"),
        (Measurement(1e-3, 8e-4, 12e-4), "differs"),
        (Measurement(1e-3), "unknown"),
        (Measurement(math.nan, 0, 1), "differs"),
    ],
)
def test_closure_is_only_met_by_a_narrow_interval_around_0(bias: Measurement, verdict: str) -> None:
    assert closure_statement(Closure({}, bias)).verdict == verdict


def test_closure_sentence() -> None:
    statement = closure_statement(Closure({}, Measurement(-1e-4, -4e-4, 2e-4)))
    assert statement.sentence == (
        "With every term exact the composition meets the reference: bias −0.00010 ± 0.00030 of the mean."
    )


def printed(renderable) -> str:
    console = Console(file=io.StringIO(), width=140, color_system=None)
    console.print(renderable)
    return console.file.getvalue()


def test_terminal_says_everything_that_matters() -> None:
    text = printed(comparison(make_results(broken=True)))
    for part in (
        "shadow_map",
        "0.0523 ± 0.0031",
        "RMSE in W/sr/m²",
        "3.41 ± 0.12",
        "✕ NaN",
        "pixels that are not finite: frame 2 at (32, 24)",
        "meets the reference",
        "left out: effect ssao: the scene has no crevice",
        "not approximated: environment_visibility",
    ):
        assert part in text


def test_terminal_reads_no_markup_in_names() -> None:
    results = Results("[red]x[/red]", (1, 1), Frame({}), left_out=(LeftOut("[/]", "[bold]"),))
    text = printed(comparison(results))
    assert "[red]x[/red]" in text
    assert "[/]: [bold]" in text


def test_what_is_left_out_for_one_reason_is_one_line() -> None:
    left_out = (
        LeftOut("phong", "the scene has no lights"),
        LeftOut("gtao", "takes part where it is asked for: --use gtao"),
        LeftOut("pcss", "the scene has no lights"),
        LeftOut("ssao", "takes part where it is asked for: --use ssao"),
    )
    text = printed(comparison(Results("x", (1, 1), Frame({}), left_out=left_out)))
    assert "left out: phong, pcss: the scene has no lights" in text
    assert "left out: gtao, ssao: takes part where it is asked for: --use EFFECT" in text


def test_metric_table() -> None:
    assert "0.500" in printed(metric_table({"rmse": Measurement(0.5, how="one image")}))


VERDICTS = [
    Verdict("box/ssao/rmse", "PASS", Measurement(0.01, 0.009, 0.011), "rmse <= 0.02", "", 1.5),
    Verdict("box/frame/<flip>&", "FAIL", Measurement(0.3), 0.2, "too \x00 visible", 0.5),
    Verdict("box/frame/ssim", "UNDECIDED", None, "ssim >= 0.9"),
]


def test_junit_counts_and_cases() -> None:
    root = ET.fromstring(to_junit(VERDICTS).encode())
    suite = root.find("testsuite")
    assert [suite.get(key) for key in ("tests", "failures", "errors", "skipped", "time")] == [
        "3",
        "1",
        "0",
        "1",
        "2.000",
    ]
    first, second, third = suite.findall("testcase")
    assert first.get("classname") == "box.ssao"
    assert first.find("failure") is None
    assert "0.0100 ± 0.0010" in first.find("system-out").text
    assert second.get("name") == "box/frame/<flip>&"
    assert second.find("failure").get("message") == "too \ufffd visible"
    assert third.find("skipped") is not None


def test_junit_strict_fails_the_undecided(tmp_path) -> None:
    root = ET.parse(write_junit(tmp_path / "j.xml", VERDICTS, strict=True)).getroot()
    assert (root.get("failures"), root.get("skipped")) == ("2", "0")
    assert root.findall(".//failure")[1].get("type") == "undecided"
