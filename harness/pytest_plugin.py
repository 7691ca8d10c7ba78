"""pytest's fixture `lightmeter`: a test of your own holds limits in one line, of a scene or of two images.

def test_the_courtyard(lightmeter):
    lightmeter.hold("scenes/courtyard.toml", "flip <= 0.12", "shadow_map.rmse <= 0.02", size="128x128")

def test_our_engine(lightmeter):
    lightmeter.hold("posts", "flip <= 0.1", "visibility.0.rmse <= 0.02", candidate="frame.exr")
    lightmeter.hold_images("frame.exr", "truth.exr", "flip <= 0.05")

pytest loads this module in every run of whoever has lightmeter installed. So nothing of weight is imported here: what
measures is imported when a test first holds something.
"""

import hashlib
import re
import time
import warnings
from argparse import ArgumentTypeError
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from inspect import signature
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from lightmeter import options
from lightmeter.failures import UsageError, explain, user_failures
from lightmeter.hints import nearest

if TYPE_CHECKING:
    import numpy as np

    from lightmeter.candidates.candidate import Candidate
    from lightmeter.reports.gate_markdown import Maps
    from lightmeter.reports.verdict import Verdict
    from lightmeter.scenes.model import Scene


class UndecidedWarning(UserWarning):
    """A limit that the samples, or the seconds, could not decide."""


def pytest_addoption(parser: pytest.Parser) -> None:
    """What all tests share; a test's own `confidence` and `seconds` go before it."""
    group = parser.getgroup("lightmeter", "lightmeter: limits on images")
    group.addoption("--lightmeter-output", metavar="DIR", help="write every test's report there, of what holds too")
    group.addoption(
        "--lightmeter-strict", action="store_true", help="fail where a limit is undecided, in place of a warning"
    )
    group.addoption("--lightmeter-confidence", metavar="C", help="that no verdict of one call is wrong")
    group.addoption("--lightmeter-seconds", metavar="S", help="time for the verdicts of one call")
    parser.addini("lightmeter_strict", "fail where a limit is undecided, in place of a warning", "bool", False)
    parser.addini("lightmeter_confidence", "that no verdict of one call is wrong", default="")
    parser.addini("lightmeter_seconds", "time for the verdicts of one call", default="")


def pytest_configure(config: pytest.Config) -> None:
    """Refuse options that make no sense before any test runs."""
    try:
        options.check_confidence(_number(config, "lightmeter_confidence"), "lightmeter_confidence")
        options.check_seconds(_number(config, "lightmeter_seconds"), "lightmeter_seconds")
    except UsageError as error:
        raise pytest.UsageError(str(error)) from None


@pytest.fixture
def lightmeter(request: pytest.FixtureRequest, tmp_path: Path) -> "Lightmeter":
    """Holds limits: `lightmeter.hold(scene, *limits)`, `lightmeter.hold_images(tested, reference, *limits)`."""
    config = request.config
    folder = tmp_path / "lightmeter"
    if asked := config.getoption("lightmeter_output"):
        folder = config.invocation_params.dir / asked / _folder_name(request.node.nodeid)
    return Lightmeter(
        confidence=_number(config, "lightmeter_confidence") or options.DEFAULT_CONFIDENCE,
        seconds=_number(config, "lightmeter_seconds"),
        strict=config.getoption("lightmeter_strict") or config.getini("lightmeter_strict"),
        folder=folder,
        always=bool(asked),
        properties=request.node.user_properties,
    )


@dataclass
class Lightmeter:
    """What the fixture gives.

    Attributes:
        confidence: that no verdict of one call is wrong.
        seconds: for the verdicts of one call; None: until the samples are spent.
        strict: whether an undecided limit fails the test.
        folder: reports go into numbered folders in it, one for each call.
        always: whether what holds gets a report, too.
        properties: (name, value) of the test: JUnit XML shows them.
    """

    confidence: float
    seconds: float | None
    strict: bool
    folder: Path
    always: bool
    properties: list[tuple[str, object]]
    calls: int = field(default=0, init=False)

    def hold(
        self,
        scene: "str | Path | Scene",
        *limits: str,
        seconds: float | None = None,
        confidence: float | None = None,
        candidate: "Candidate | str | Path | None" = None,
        **how: Any,
    ) -> "list[Verdict]":
        """Judge a scene's frame and effects; the test fails where a limit does not hold.

        Args:
            scene: a library name, a path, or a scene.
            limits: "[EFFECT.]METRIC <= NUMBER", or >=; all forms are in `limit_text.parse_limit`.
            seconds, confidence: in place of those of the run.
            candidate: another renderer, or its frame's file, to be judged in place of our own frame.
            how: size ("128x128"), spp, seed, camera, only, without, use and knobs, as in `holding.conditions`.

        Returns:
            A verdict for each limit, in their order.
        """
        sure = self.confidence if confidence is None else confidence
        with _errors_in_one_message():
            from lightmeter.gate_pictures import error_maps
            from lightmeter.groundtruth.store import Store
            from lightmeter.holding import conditions, hold_trials

            known = [*signature(conditions).parameters, "seconds", "confidence", "candidate"]
            for name in how:
                if name not in known:
                    raise UsageError(f"hold takes no {name!r}; {nearest(name, known)}")
            start = time.perf_counter()
            budget = self.seconds if seconds is None else seconds
            store = Store(say=options.say)
            trials = hold_trials(scene, limits, conditions(**how), budget, sure, store, candidate)
            verdicts = [trial.verdict for trial in trials if trial.verdict]
            took = time.perf_counter() - start
            report = self._write(verdicts, lambda: error_maps(trials), sure, took)
        self._conclude(verdicts, report, sure)
        return verdicts

    def hold_images(
        self,
        tested: "str | Path | np.ndarray",
        reference: "str | Path | np.ndarray",
        *limits: str,
        confidence: float | None = None,
    ) -> "list[Verdict]":
        """Judge an image by a reference; the test fails where a limit does not hold.

        Args:
            tested: a PNG, EXR or HDR file; or an array (H, W, 3), scene-linear.
            reference: the same; or (K, H, W, 3), K independent noisy batches of it.
            limits: "METRIC <= NUMBER", or >=.
            confidence: in place of that of the run.

        Returns:
            A verdict for each limit, in their order.
        """
        sure = self.confidence if confidence is None else confidence
        with _errors_in_one_message():
            from lightmeter.given_images import judge_images

            start = time.perf_counter()
            verdicts, maps = judge_images(tested, reference, limits, sure)
            report = self._write(verdicts, maps, sure, time.perf_counter() - start)
        self._conclude(verdicts, report, sure)
        return verdicts

    def _write(
        self, verdicts: "list[Verdict]", maps: "Callable[[], Maps]", confidence: float, took: float
    ) -> Path | None:
        """The gate's Markdown with its heatmaps, in a folder of this call; None where nobody needs it."""
        self.calls += 1
        if not self.always and all(verdict.status == "PASS" for verdict in verdicts):
            return None
        from lightmeter.reports.gate_markdown import write_markdown

        folder = options.output_folder(self.folder / str(self.calls))
        return write_markdown(folder / "report.md", verdicts, maps(), confidence, took)

    def _conclude(self, verdicts: "list[Verdict]", report: Path | None, confidence: float) -> None:
        """Note the verdicts for JUnit, and fail or warn."""
        from lightmeter.reports.gate_text import to_line, to_text

        self.properties += [(f"lightmeter {verdict.name}", to_line(verdict)) for verdict in verdicts]
        lost = ("FAIL", "UNDECIDED") if self.strict else ("FAIL",)
        if any(verdict.status in lost for verdict in verdicts):
            pytest.fail(f"{to_text(verdicts, confidence)}\nreport: {report}", pytrace=False)
        undecided = [f"{verdict.scene}: {verdict.message}" for verdict in verdicts if verdict.status == "UNDECIDED"]
        if undecided:
            message = "\n".join([*undecided, f"report: {report}"])
            warnings.warn(message, UndecidedWarning, stacklevel=3)


@contextmanager
def _errors_in_one_message() -> Iterator[None]:
    """A limit or a scene that makes no sense fails the test with what is to be mended, not with a traceback."""
    try:
        yield
    except Exception as error:
        if not isinstance(error, user_failures()):
            raise
        raise pytest.fail.Exception(f"lightmeter: error: {explain(error)}", pytrace=False) from None


def _number(config: pytest.Config, name: str) -> float | None:
    """An option, or else the value in pytest's ini-file; None where neither is given."""
    option = config.getoption(name)
    text = config.getini(name) if option is None else option
    try:
        return options.number(text) if text else None
    except ArgumentTypeError as error:
        raise pytest.UsageError(f"{name}: {error}") from None


def _folder_name(test: str) -> str:
    """A folder's name for a test; the digest tells tests apart whose names differ only in what a folder cannot hold."""
    plain = re.sub(r"[^\w.=+]+", "-", test).strip("-.")[-100:]
    return f"{plain}-{hashlib.sha256(test.encode()).hexdigest()[:8]}"
