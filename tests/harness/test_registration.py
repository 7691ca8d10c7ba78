"""Registration on real frames: planted faults are named with their size, and right frames raise nothing.

`benchmarks/registration.py` counts the same over all scenes, sizes and more seeds (docs/registration.md).
"""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.groundtruth.batches import reference
from lightmeter.metrics.registration import correct, find_faults
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes import library
from lightmeter.scenes.load import load
from lightmeter.scenes.optics.color import srgb_decode, srgb_encode

SIDE = 96
SCENE = "metal-rough-grid"
PIXELS = 0.1
"""What the frame's own shading and its one sample a pixel may pull edges by: a box of a pixel is σ = 0.29, over some
hundred edges that are off independently 0.03; highlights that are off alike add to it."""
ZOOM = 1.03
FACTOR = 0.02
"""Most of the frame is right to 1 %; the levels' histogram and the truth's noise add as much."""


class Own:
    """Our renderer's frames of a scene."""

    def __init__(self, device, name, side):
        self._device, self._scene, self._size = device, load(name), (side, side)
        self.batches = reference(self._scene, self._size, spp=8).batches
        self.points = self._renderer(Choice()).capture(terms=False).points
        self.background = ~self.points.hit

    def frame(self, right=0.0, down=0.0, zoom=1.0, choice=None):
        """(H, W, 3), the content shifted by so many pixels, with another field of view."""
        renderer = self._renderer(choice or Choice(), zoom)
        renderer.offsets = renderer.offsets - np.array([right, down])
        return renderer.render().radiance

    def _renderer(self, choice, zoom=1.0):
        camera = self._scene.camera
        wider = replace(camera, yfov=float(2 * np.arctan(zoom * np.tan(camera.yfov / 2))))
        plan = compile_plan(replace(self._scene, camera=wider), effects(), choice)
        return Renderer(self._device, plan, self._size)

    def faults(self, tested, **options):
        return find_faults(np.asarray(tested, np.float32), self.batches, background=self.background, **options)


@pytest.fixture(scope="module")
def device():
    return Device()


@pytest.fixture(scope="module")
def own(device):
    return Own(device, SCENE, SIDE)


def names(faults):
    return [fault.name for fault in faults]


@pytest.mark.parametrize("right, down", [(0.5, 0), (-0.5, 0.5), (1, -2.25)])
def test_a_shift(own, right, down):
    (fault,) = own.faults(own.frame(right, down))
    assert fault.name == "shift"
    assert fault.size == pytest.approx({"right": right, "down": down}, abs=PIXELS)


@pytest.mark.parametrize("zoom", [ZOOM, 2 - ZOOM])
def test_a_field_of_view(own, zoom):
    (fault,) = own.faults(own.frame(zoom=zoom))
    percent = 100 * (zoom - 1)
    assert fault.name == "field_of_view"
    expected = {"horizontal": percent, "vertical": percent}
    assert fault.size == pytest.approx(expected, abs=100 * PIXELS / (SIDE / 2) + 0.01 * abs(percent))


@pytest.mark.parametrize("across, upright", [(True, False), (False, True), (True, True)])
def test_a_flip(own, across, upright):
    tested = own.frame()[:: -1 if upright else 1, :: -1 if across else 1]
    (fault,) = own.faults(tested)
    assert fault.name == "flip" and fault.size == {"left_right": across, "up_down": upright}


@pytest.mark.parametrize("factor", [1.5, 0.8])
def test_an_exposure(own, factor):
    (fault,) = own.faults(factor * own.frame())
    assert fault.name == "exposure"
    assert fault.size["factor"] == pytest.approx(factor, rel=FACTOR)


@pytest.mark.parametrize(
    "curve, exponent", [(srgb_encode, 1 / 2.2), (srgb_decode, 2.2), (lambda x: np.maximum(x, 0) ** (1 / 2.2), 1 / 2.2)]
)
def test_a_transfer(own, curve, exponent):
    (fault,) = own.faults(curve(own.frame().astype(np.float64)))
    assert fault.name == "transfer"
    # 5 % of a level over the picture's range of 3 : 1 (see test_light).
    assert fault.size["exponent"] == pytest.approx(exponent, rel=0.05 / np.log(3))


def test_colours_multiplied_by_alpha(own):
    alpha = np.where(own.points.shape % 5 == 1, 0.6, 1.0)  # every fifth sphere is a veil
    lit = own.batches.mean(axis=(0, 3)) > 0
    assert own.faults(own.frame(), alpha=alpha) == ()
    (fault,) = own.faults(own.frame() * alpha[..., None], alpha=alpha)
    assert fault.name == "alpha" and fault.size == {"pixels": np.count_nonzero((alpha < 1) & lit), "lost": 0}


def test_a_missing_background(own):
    (fault,) = own.faults(np.where(own.background[..., None], 0, own.frame()))
    assert fault.name == "background" and fault.size["pixels"] == np.count_nonzero(own.background)


def test_several_at_once(own):
    tested = srgb_encode(1.5 * own.frame(right=-1, down=0.75)[:, ::-1].astype(np.float64)).astype(np.float32)
    faults = own.faults(tested)
    assert names(faults) == ["flip", "shift", "transfer", "exposure"]
    assert faults[1].size == pytest.approx({"right": -1, "down": 0.75}, abs=PIXELS)
    assert faults[3].size["factor"] == pytest.approx(1.5, rel=2 * FACTOR)
    assert own.faults(correct(tested, faults)) == ()


@pytest.mark.parametrize("name", library.names())
def test_right_frames_raise_nothing(device, name):
    own = Own(device, name, 64)
    choices = [
        Choice(),
        Choice(without=("constant_ambient",)),
        Choice(without=("shadow_map",)),
        Choice(settings={"supersampling": {"grid": 3}}),
    ]
    for choice in choices:
        assert own.faults(own.frame(choice=choice)) == (), choice
    # The truth itself, at as few samples as one batch has.
    assert find_faults(own.batches[0], own.batches[1:], background=own.background) == ()
