"""Limits on other renderers' frames."""

import numpy as np
import pytest

from lightmeter.failures import UsageError
from lightmeter.holding import conditions, hold
from lightmeter.reports.image_files import write_exr

from .frames import own_renderer, write_own_frame

HEAD = '[defaults]\nsize = "32x32"\nspp = 16\n'


@pytest.fixture
def write(tmp_path):
    """Writes lightmeter.toml with one candidate and these limits on it; and the candidate's frame, ours."""

    def call(*limits: str, candidate: str = 'file = "frame.exr"') -> None:
        text = HEAD + f'[[candidate]]\nname = "engine"\n{candidate}\n'
        text += "".join(f'[[limit]]\nscene = "torus"\ncandidate = "engine"\n{limit}\n' for limit in limits)
        (tmp_path / "lightmeter.toml").write_text(text)

    return call


@pytest.fixture
def own_frame(tmp_path):
    return write_own_frame(tmp_path / "frame.exr", own_renderer("torus", (32, 32)))


def test_limits_on_a_frame_a_layer_and_the_mask(run, write, own_frame):
    write(
        'metric = "relative_bias"\nmax = 0.9',
        'of = "visibility.0"\nmetric = "nrmse"\nmax = 5.0',
        'metric = "masked"\nmax = 0.1',
        'metric = "relative_bias"\nmax = 1e-6',
    )
    ran = run("gate", "--json")
    assert [v["status"] for v in ran.json["verdicts"]] == ["PASS", "PASS", "PASS", "FAIL"]
    assert [v["of"] for v in ran.json["verdicts"]] == ["engine", "engine visibility.0", "engine", "engine"]


def test_too_many_masked_pixels_fail(run, write, own_frame):
    write('metric = "masked"\nmax = 0.1', candidate='file = "frame.exr"\nunsupported = { objects = ["floor"] }')
    ran = run("gate", "--json")
    assert ran.code == 1
    assert ran.json["verdicts"][0]["value"] > 0.1


def test_the_command_line_puts_a_candidate_in_our_frames_place(run, tmp_path, own_frame):
    (tmp_path / "lightmeter.toml").write_text(
        HEAD + '[[limit]]\nscene = "torus"\nmetric = "relative_bias"\nmax = 0.9\n'
        '[[limit]]\nscene = "torus"\nof = "shadow_map"\nmetric = "nrmse"\nmax = 9.0\n'
    )
    ran = run("gate", "--candidate", "theirs=frame.exr", "--json")
    assert [v["name"] for v in ran.json["verdicts"]] == ["torus/theirs/relative_bias"]
    assert "1 limits that are not on a frame of theirs are left out" in ran.err


def test_a_frame_that_is_not_there_fails_its_limit_and_no_other(run, tmp_path):
    (tmp_path / "lightmeter.toml").write_text(
        HEAD + '[[candidate]]\nname = "engine"\ncommand = "false"\n'
        '[[limit]]\nscene = "torus"\nmetric = "relative_bias"\nmax = 0.9\n'
        '[[limit]]\nscene = "torus"\nmetric = "flip"\nmax = 0.9\ncandidate = "engine"\n'
    )
    ran = run("gate", "--json")
    assert ran.code == 1
    assert [v["status"] for v in ran.json["verdicts"]] == ["PASS", "FAIL"]
    assert "exit code 1" in ran.err


def test_radiance_is_not_asked_of_a_display_image(run, write, tmp_path):
    write_exr(tmp_path / "frame.exr", np.full((32, 32, 3), 0.5, np.float32))
    write('metric = "rmse"\nmax = 1.0', candidate='file = "frame.exr"\ntransfer = "srgb"')
    ran = run("gate", "--json")
    assert ran.code == 1
    assert "speaks of radiance" in ran.err


@pytest.mark.parametrize(
    ("limit", "said"),
    [
        ('metric = "time_ms"\nmax = 3.0\ndevice = "x"', "not limited here"),
        ('metric = "masked"\nmin = 0.5', "expected max alone"),
        ('of = "visibilty.0"\nmetric = "rmse"\nmax = 1.0', "did you mean"),
        ('of = "normal"\nmetric = "rmse"\nmax = 1.0', "has no 'normal' to judge"),
    ],
)
def test_limits_that_make_no_sense_are_refused_before_anything_is_rendered(refused, write, limit, said):
    write(limit)
    assert said in refused("gate")


def test_a_candidate_that_is_not_described_is_refused(refused, tmp_path):
    (tmp_path / "lightmeter.toml").write_text(
        HEAD + '[[candidate]]\nname = "engine"\ncommand = "false"\n'
        '[[limit]]\nscene = "torus"\nmetric = "flip"\nmax = 0.9\ncandidate = "engin"\n'
    )
    assert "did you mean 'engine'" in refused("gate")


def test_a_python_test_holds_another_renderers_frame(own_frame, tmp_path):
    how = conditions(size="32x32", spp=16)
    verdicts = hold("torus", ["relative_bias <= 0.9", "visibility.0.nrmse <= 5"], how, candidate=own_frame)
    assert [(v.name, v.status) for v in verdicts] == [
        ("torus/frame.exr/relative_bias", "PASS"),
        ("torus/frame.exr visibility.0/nrmse", "PASS"),
    ]
    with pytest.raises(UsageError, match=r"has no 'visibilty\.0' to judge"):
        hold("torus", ["visibilty.0.nrmse <= 5"], how, candidate=own_frame)
