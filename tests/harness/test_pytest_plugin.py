"""The fixture `lightmeter` in a user's own tests, run by an inner pytest."""

import json
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from lightmeter.pytest_plugin import Lightmeter
from tests.harness.small_images import exr, noise, png

ALONE = ("-p", "no:cacheprovider", "-p", "no:hypothesispytest", "--tb=native")
"""Hypothesis would be loaded, and forgotten, by every inner run. A traceback of pytest's own style looks at every
module's attributes, which changes Dr.Jit's for good: what is forgotten then takes the process down later."""

SMALL = 'size="16x16", spp=16'
HOLDS = f'lightmeter.hold("plane", "flip <= 0.5", "ssim >= 0.5", {SMALL})'
FAILS = f'lightmeter.hold("plane", "flip <= 0.5", "narkowicz.nrmse <= 1e-9", {SMALL})'
UNDECIDED = f'lightmeter.hold("plane", "rmse <= 1e-6", {SMALL})'
"""The plane's frame is all but perfect: no reference of 16 samples tells its error from this."""


@pytest.fixture(scope="module")
def loaded(tmp_path_factory, shared_store):
    """Every module that the fixture needs: an inner pytest forgets those it loads, and not all can be loaded twice."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("LIGHTMETER_STORE", str(shared_store))
        fixture = Lightmeter(0.999, None, False, tmp_path_factory.mktemp("loaded"), True, [])
        with pytest.raises(pytest.fail.Exception):
            fixture.hold("plane", "flip <= 0.5", "ssim >= 0.5", "narkowicz.nrmse <= 1e-9", size="16x16", spp=16)
        fixture.hold_images(noise(), noise(), "flip <= 0.5", "rmse <= 0.5")


@pytest.fixture
def inner(pytester, loaded, monkeypatch, shared_store):
    """Runs pytest on a test with these lines in it."""
    monkeypatch.setenv("LIGHTMETER_STORE", str(shared_store))

    def call(*lines: str, options=()) -> pytest.RunResult:
        body = "\n    ".join(lines)
        pytester.makepyfile(f"def test_quality(lightmeter):\n    {body}\n")
        return pytester.runpytest_inprocess(*ALONE, *options)

    return call


def folder_of(result: pytest.RunResult) -> Path:
    """The folder of the report that a run names."""
    line = next(line for line in result.outlines if "report: " in line)
    return Path(line.split("report: ")[1]).parent


def test_importing_the_plugin_loads_nothing_of_weight():
    heavy = ("numpy", "mitsuba", "drjit", "moderngl", "scipy", "PIL", "pydantic", "rich", "OpenEXR")
    source = f"import json, sys, lightmeter.pytest_plugin; print(json.dumps([m for m in {heavy} if m in sys.modules]))"
    done = subprocess.run([sys.executable, "-P", "-c", source], capture_output=True, text=True, check=True)
    assert json.loads(done.stdout) == []


def test_limits_that_hold(inner):
    result = inner(f"verdicts = {HOLDS}", 'assert [v.status for v in verdicts] == ["PASS", "PASS"]')
    result.assert_outcomes(passed=1)
    assert not [line for line in result.outlines if "report: " in line]


def test_a_limit_that_fails_shows_the_gates_table_and_names_its_report(inner, pytester):
    result = inner(FAILS)
    result.assert_outcomes(failed=1)
    text = result.stdout.str()
    result.stdout.fnmatch_lines(["lightmeter: 1 failed, 1 held at confidence 0.999"])
    result.stdout.re_match_lines([r" FAIL +plane/narkowicz +nrmse <= 1e-09 +0\.0\d+ ± \S+ +\d+ "])
    result.stdout.re_match_lines([r"plane: nrmse of narkowicz = 0\.\d+ \(0\.\d+ … 0\.\d+\) is beyond the limit"])
    assert "Traceback" not in text and "pytest_plugin.py" not in text
    folder = folder_of(result)
    assert pytester.path in folder.parents or "pytest-" in str(folder)
    comment = (folder / "report.md").read_text()
    assert comment.startswith("### ❌ lightmeter: 1 failed, 1 held")
    for name in ("report.1.png", "report.2.png"):
        assert f"![FLIP]({name})" in comment
        with Image.open(folder / name) as picture:
            assert picture.size == (160, 160)


def test_an_undecided_limit_warns_or_with_strict_fails(inner, pytester):
    result = inner(UNDECIDED)
    result.assert_outcomes(passed=1, warnings=1)
    result.stdout.re_match_lines([r".*test_.*\.py:2: UndecidedWarning: plane: rmse of frame = .*larger spp"])
    assert (folder_of(result) / "report.1.png").exists()
    strict = inner(UNDECIDED, options=["--lightmeter-strict"])
    strict.assert_outcomes(failed=1)
    strict.stdout.fnmatch_lines(["lightmeter: 1 undecided at confidence 0.999", " UNDECIDED *plane/frame *"])
    pytester.makeini("[pytest]\nlightmeter_strict = true\n")
    inner(UNDECIDED).assert_outcomes(failed=1)


MISTAKES = {
    "metric": (f'hold("plane", "flp <= 1", {SMALL})', "Did you mean 'flip'?"),
    "form": (f'hold("plane", "flip < 1", {SMALL})', "expected [[]EFFECT.]METRIC <= NUMBER"),
    "none": (f'hold("plane", {SMALL})', "at least one"),
    "effect": (f'hold("plane", "cook_torance.flip <= 1", {SMALL})', "'cook_torrance'"),
    "scene": (f'hold("plnae", "flip <= 1", {SMALL})', "Did you mean 'plane'?"),
    "keyword": ('hold("plane", "flip <= 1", siz="16x16")', "did you mean 'size'?"),
    "size": ('hold("plane", "flip <= 1", size="16")', "expected WxH"),
    "spp": ('hold("plane", "flip <= 1", spp=4)', "spp: expected 8 to"),
    "knobs": ('hold("plane", "flip <= 1", knobs={"supersampling.grid": 2})', "for 'supersampling.grid'"),
    "knob": ('hold("plane", "flip <= 1", knobs={"supersampling": {"gird": 2}})', "'grid'"),
    "confidence": ('hold("plane", "flip <= 1", confidence=1)', "confidence: expected 0.5 or more and below 1"),
    "seconds": ('hold("plane", "flip <= 1", seconds=0)', "seconds: expected a time above 0"),
    "file": ('hold_images("gone.exr", "gone.exr", "flip <= 1")', "gone.exr"),
    "images' effect": ("hold_images(image, image, 'srgb.flip <= 1')", "two images have no effects"),
    "bytes": ("hold_images((image * 255).astype('uint8'), image, 'flip <= 1')", "got uint8"),
    "grey": ("hold_images(image, image[..., 0], 'flip <= 1')", "the reference: expected an array (height, width, 3)"),
    "sizes": ("hold_images(image, image[:8], 'flip <= 1')", "differ in size"),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_fails_with_one_message(inner, mistake):
    call, named = MISTAKES[mistake]
    result = inner("import numpy as np", "image = np.ones((16, 16, 3))", f"lightmeter.{call}")
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines([f"lightmeter: error: *{named}*"])
    text = result.stdout.str()
    assert "Traceback" not in text and "During handling" not in text and "pytest_plugin.py" not in text


def test_an_option_that_makes_no_sense_is_refused_before_any_test(inner, pytester):
    result = inner(HOLDS, options=["--lightmeter-confidence", "high"])
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines(["ERROR: lightmeter_confidence: expected a number, got 'high'"])
    pytester.makeini("[pytest]\nlightmeter_seconds = 0\n")
    inner(HOLDS).stderr.fnmatch_lines(["ERROR: lightmeter_seconds: expected a time above 0 *"])


def test_options_and_ini_give_what_a_call_does_not(inner, pytester):
    pytester.makeini("[pytest]\nlightmeter_confidence = 0.9\nlightmeter_seconds = 1e-6\n")
    inner(HOLDS).stdout.fnmatch_lines(["*UndecidedWarning*the time budget of 1e-06 s ended*"])
    result = inner(FAILS, options=["--lightmeter-seconds", "60"])
    result.stdout.fnmatch_lines(["lightmeter: 1 failed, 1 held at confidence 0.9"])
    result = inner(FAILS.replace(SMALL, f"{SMALL}, seconds=60, confidence=0.99"))
    result.stdout.fnmatch_lines(["lightmeter: 1 failed, 1 held at confidence 0.99"])


def test_two_files_or_a_file_and_an_array(inner, pytester):
    image = noise(32, 24)
    exr(pytester.path / "frame.exr", image * 0.5)
    exr(pytester.path / "truth.exr", image)
    png(pytester.path / "frame.png", image)
    result = inner('lightmeter.hold_images("frame.exr", "truth.exr", "flip <= 0.05", "rmse <= 9")')
    result.assert_outcomes(failed=1)
    result.stdout.re_match_lines([r" FAIL +images/frame +flip <= 0\.05 +0\.\d+ "])
    with Image.open(folder_of(result) / "report.1.png") as picture:
        assert picture.size == (160, 120)
    inner(
        "from pathlib import Path",
        "from lightmeter.image_pair import read",
        'lightmeter.hold_images(Path("truth.exr"), read(Path("truth.exr")).values, "rmse <= 0")',
        'lightmeter.hold_images("frame.png", "frame.png", "flip <= 0")',
    ).assert_outcomes(passed=1)


def test_batches_of_a_reference_leave_open_what_their_noise_hides(inner):
    lines = (
        "import numpy as np",
        "image = np.full((16, 16, 3), 0.5)",
        "batches = image + np.random.default_rng(1).normal(0, 0.1, (16, 16, 16, 3))",
    )
    inner(*lines, "lightmeter.hold_images(image, batches, 'rmse <= 0.1')").assert_outcomes(passed=1)
    inner(*lines, "lightmeter.hold_images(image, batches, 'rmse <= 1e-4')").assert_outcomes(passed=1, warnings=1)
    inner(*lines, "lightmeter.hold_images(image + 1, batches, 'rmse <= 0.1')").assert_outcomes(failed=1)


def test_a_pixel_that_is_not_finite_fails_and_is_found(inner):
    result = inner(
        "import numpy as np",
        "broken = np.ones((16, 16, 3))",
        "broken[3, 4] = np.nan",
        "lightmeter.hold_images(broken, np.ones((16, 16, 3)), 'flip <= 1')",
    )
    result.assert_outcomes(failed=1)
    result.stdout.fnmatch_lines(["images: *row 3, column 4*"])


def test_every_call_has_a_folder_of_its_own_where_asked(pytester, loaded):
    """Names that a folder cannot hold are told apart, and what holds is reported too."""
    pytester.makepyfile(
        """
        import numpy as np
        import pytest

        @pytest.mark.parametrize("name", ["a/b", "a:b"])
        def test_quality(lightmeter, name, monkeypatch, tmp_path):
            monkeypatch.chdir(tmp_path)
            for level in (0.5, 1.0):
                image = np.full((16, 16, 3), level)
                lightmeter.hold_images(image, image, "flip <= 0.1", "rmse <= 0.1")
        """
    )
    result = pytester.runpytest_inprocess(*ALONE, "--lightmeter-output", "out")
    result.assert_outcomes(passed=2)
    reports = sorted((pytester.path / "out").glob("*/*/report.md"))
    assert [path.parent.name for path in reports] == ["1", "2", "1", "2"]
    assert all(path.read_text().startswith("### ✅ lightmeter: 2 held") for path in reports)


def test_junit_tells_every_verdict(inner, pytester):
    result = inner(FAILS, options=["--junitxml", "out.xml"])
    assert "incompatible" not in result.stdout.str()
    case = next(ET.parse(pytester.path / "out.xml").getroot().iter("testcase"))
    told = {entry.get("name"): entry.get("value") for entry in case.iter("property")}
    assert list(told) == ["lightmeter plane/frame/flip", "lightmeter plane/narkowicz/nrmse"]
    assert told["lightmeter plane/frame/flip"].startswith("PASS: 0.0")
    assert told["lightmeter plane/narkowicz/nrmse"].startswith("FAIL: 0.0")
    assert "limit nrmse <= 1e-09, " in told["lightmeter plane/narkowicz/nrmse"]
    failure = case.find("failure")
    assert failure is not None and "1 failed, 1 held" in str(failure.text)


def test_a_fault_of_lightmeter_itself_is_not_taken_for_the_users(loaded, monkeypatch, tmp_path):
    from lightmeter import holding

    monkeypatch.setattr(holding, "hold_trials", lambda *_: np.zeros(1)[2])
    with pytest.raises(IndexError):
        Lightmeter(0.999, None, False, tmp_path, False, []).hold("plane", "flip <= 1")
