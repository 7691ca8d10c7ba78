"""The budget that limits share, and what becomes of what it leaves open."""

import math
from types import SimpleNamespace

import pytest

from lightmeter import gating
from lightmeter.gating import Work, decide
from lightmeter.holding import conditions, hold, hold_images
from lightmeter.limit_text import parse_limit
from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.sequential import Bound
from lightmeter.trials import Trial


class Subject:
    """A number 1 whose interval's half-width is 1/amount, where each unit takes `cost` seconds of a clock."""

    looks = (8, 16, 32, 64)

    def __init__(self, clock, cost: float, count: float = math.inf, doubt: str = ""):
        self.clock, self.cost, self.samples, self._count, self._doubt = clock, cost, 0, count, doubt
        self.steps: list[float] = []

    def advance(self, to, go_on):
        while self.samples < to:
            if not go_on():
                return False
            self.clock.now += self.cost
            self.samples += 1
        self.steps.append(self.clock.now)
        return True

    def broken(self, limit):
        return None

    def doubt(self):
        return self._doubt

    def measure(self, limit, confidence):
        return Measurement(1.0, 1 - 1 / self.samples, 1 + 1 / self.samples)

    def count(self, limit):
        return self._count


class Clock:
    now = 0.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def run(monkeypatch):
    """Decides subjects of these costs, each with a limit; gives the verdicts and the subjects."""

    def call(costs, limits, seconds=None, count=math.inf, doubt=""):
        clock = Clock()
        case = SimpleNamespace(name="scene", pixels=lambda limit: 4)
        subjects = [Subject(clock, cost, count, doubt) for cost in costs]
        trials = [
            Trial(parse_limit(f"rmse <= {high}", conditions()), case, Bound(high, high), 0.001)  # pyright: ignore
            for high in limits
        ]
        works = [Work(subject, [trial]) for subject, trial in zip(subjects, trials, strict=True)]
        monkeypatch.setattr(gating, "_works", lambda _: works)
        return decide(trials, seconds, clock=clock), subjects

    return call


def test_each_stops_when_it_is_decided(run):
    verdicts, _ = run([1, 1], [1.2, 1.02])
    assert [(v.status, v.samples, v.looks) for v in verdicts] == [("PASS", 8, 1), ("PASS", 64, 4)]
    assert verdicts[1].error == pytest.approx(0.001)


def test_what_has_taken_least_comes_next(run):
    """The dear one's first look takes 80: the cheap one, at 64 after all its looks, is never before it then."""
    verdicts, (cheap, dear) = run([1, 10], [1.001, 1.2])
    assert [v.status for v in verdicts] == ["UNDECIDED", "PASS"]
    assert dear.steps == [88.0]
    assert cheap.steps == [8.0, 96.0, 112.0, 144.0]


def test_one_time_budget_serves_all_and_is_not_overrun(run):
    verdicts, subjects = run([1, 1, 1], [1.2, 1.01, 1.01], seconds=30)
    assert [v.status for v in verdicts] == ["PASS", "UNDECIDED", "UNDECIDED"]
    assert subjects[0].clock.now == 30
    assert "30 s ended" in verdicts[1].reason and verdicts[1].looks == 1
    verdicts, _ = run([10, 10], [1.2, 1.2], seconds=80)
    assert "before the first look" in verdicts[1].reason


def test_heavy_tails_end_undecided_with_the_reason(run):
    verdicts, _ = run([1], [1.5], count=3.0)
    assert (verdicts[0].status, verdicts[0].samples) == ("UNDECIDED", 64)
    assert "heavy tails: as few as 3 samples" in verdicts[0].reason


def test_a_truth_that_fails_its_own_checks_decides_nothing(run):
    verdicts, subjects = run([1, 1], [1.5, 0.1], doubt="the reference is not to be trusted")
    assert [(v.status, v.samples) for v in verdicts] == [("UNDECIDED", 0)] * 2
    assert {v.reason for v in verdicts} == {"the reference is not to be trusted"}
    assert [subject.steps for subject in subjects] == [[], []]


def test_a_limit_in_words():
    found = parse_limit("shadow_map.time_ratio to frame <= 0.5", conditions())
    assert (found.of, found.metric, found.to, found.high) == ("shadow_map", "time_ratio", "frame", 0.5)
    found = parse_limit("ssim >= 9e-1 on object post 4 cm, rail", conditions())
    assert (found.of, found.low, found.region.names) == ("frame", 0.9, ("post 4 cm", "rail"))
    assert parse_limit("flip<=.1 without background", conditions()).region.kind == "surfaces"
    for text in ("flip", "flip < 1", "flip <= x", "flip <= inf", "flip <= 1 on planet x", "a.b.c <= 1", ""):
        with pytest.raises(ValueError, match="expected"):
            parse_limit(text, conditions())


def test_a_scene_held_from_python():
    verdicts = hold("plane", ["relative_bias <= 0.5", "narkowicz.rmse <= 1e-6"], conditions((16, 16), spp=16))
    assert [v.status for v in verdicts] == ["PASS", "FAIL"]
    with pytest.raises(ValueError, match="'narkowicz'"):
        hold("plane", ["narkowitz.rmse <= 1"], conditions((16, 16)))


def test_two_images_held_from_python():
    import numpy as np

    image = np.full((16, 16, 3), 0.5, np.float32)
    noisy = image + 0.1 * np.random.default_rng(1).normal(size=(9, 16, 16, 3)).astype(np.float32)
    verdicts = hold_images(image, image + 0.01, ["rmse <= 0.02", "flip <= 1e-6", "ssim >= 0.5"])
    assert [v.status for v in verdicts] == ["PASS", "FAIL", "PASS"]
    assert [v.status for v in hold_images(image, noisy, ["rmse <= 0.5", "rmse <= 1e-4"])] == ["PASS", "UNDECIDED"]
    for text in ("srgb.flip <= 1", "time_ms <= 1", "flip <= 1 without background"):
        with pytest.raises(ValueError, match="two images have no"):
            hold_images(image, image, [text])
