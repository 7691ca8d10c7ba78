"""Scenes at the edges: both sides are finite or say why not, and what must look the same does."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter import stiff_scenes
from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.model import Image, Texture
from lightmeter.scenes.stiff import CASES, chosen
from lightmeter.scenes.stiff.case import StiffCase, room
from lightmeter.stiff_scenes import examine


@pytest.fixture(scope="module")
def findings():
    return {found.name: found for found in examine(CASES, CASES)}


@pytest.mark.parametrize("name", CASES)
def test_both_sides_are_finite_or_the_scene_is_refused_with_its_fault(findings, name):
    found, case = findings[name], CASES[name]
    assert found.finite, found.words
    assert found.refused == bool(case.refused), found.words
    assert case.refused in found.words


@pytest.mark.parametrize("name", ["depth-range", "small", "large"])
def test_a_frame_is_the_same_at_every_scale(findings, name):
    """A power of two rounds no float32, and the planes of the camera move no ray: only an absolute length can show.

    2⁻¹⁰ of the mean is ten times float32's epsilon for each of a thousand operations.
    """
    assert findings[name].frame_changed < 2**-10, findings[name].blame


def test_a_change_of_place_is_seen_and_named(findings):
    """The frame's float32 is measured: the truth, in a frame of its own, is the same there."""
    found = findings["offset"]
    assert found.frame_changed > 0.01
    assert found.blame[0][1] > 0.01
    assert found.error > 1.05 * findings["plain"].error


@pytest.mark.parametrize("name", ["depth-range", "offset", "small", "large"])
def test_the_truth_is_the_same_everywhere_and_at_every_size(findings, name):
    """A ray's offset of 2·10⁻⁴ of the scene moves the edge of the ball's shadow by 0.25 % of the ball, which covers a
    tenth of the image: 2.5·10⁻⁴ of what is lit."""
    assert findings[name].truth_changed < 1e-3
    assert not findings[name].words


def test_surfaces_in_one_place_have_no_truth(findings):
    """The order in which they are named decides the frame, and nothing that is seen depends on it."""
    assert findings["coplanar-reversed"].frame_changed > 0.01


def test_slow_convergence_is_said(findings):
    assert findings["white"].noise > stiff_scenes.NOISY
    assert "not converged" in findings["white"].words
    assert not findings["plain"].words


def test_what_is_dark_is_dark(findings):
    for name in ("black", "no-lights"):
        assert findings[name].words == "the reference is black, and the frame at most 0"
    assert "the reference is black" in findings["light-inside"].words


def test_a_fault_is_found(monkeypatch):
    """A NaN in a frame is located, and named."""
    made = stiff_scenes._render

    def broken(device, case, seed, captured):
        sides = made(device, case, seed, captured)
        frame = sides.frame.copy()
        frame[2, 3, 0] = np.nan
        return replace(sides, frame=frame)

    monkeypatch.setattr(stiff_scenes, "_render", broken)
    case = StiffCase("broken", room, size=(8, 8))
    (found,) = examine({"broken": case}, {"broken": case})
    assert not found.finite
    assert found.words == "frame: 1 non-finite pixel (1 NaN), first at row 2, column 3"


def test_blame_names_what_changed():
    def dim():
        lamp, sun = room().lights
        return replace(room(), lights=(replace(lamp, intensity=(3.0, 3.0, 3.0)), sun))

    plain, dimmer = StiffCase("plain", room, size=(8, 8)), StiffCase("dimmer", dim, size=(8, 8), like="plain")
    (found,) = examine({"dimmer": dimmer}, {"plain": plain, "dimmer": dimmer})
    assert found.blame[0][0] == "cook_torrance"
    assert found.blame[-1][1] == 0
    assert found.frame_changed > 0.05


@pytest.mark.parametrize(("value", "words"), [(np.nan, "1 NaN"), (-np.inf, "1 -inf"), (-1e-30, "1 below 0")])
def test_a_texel_that_is_no_colour_is_located(value, words):
    texels = np.full((3, 5, 3), 0.5, np.float32)
    texels[1, 4, 2] = value
    with pytest.raises(SceneError, match=f"{words}, the first in row 1, column 4, channel 2"):
        Texture(Image(texels, "odd"))
    Texture(Image(np.zeros((1, 1, 3), np.float32)))


def test_an_unknown_scene_is_named():
    with pytest.raises(SceneError, match="Did you mean 'offset'"):
        chosen(["ofset"])
