"""Faults planted into frames of real scenes are named with their size, and right frames raise none.

The right frames are a path tracer's with random numbers of its own, and our real-time renderer's, which err as engines
do.
"""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from lightmeter.metrics.registration import correct, find_faults
from lightmeter.options import Budget
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes import library
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Scene
from lightmeter.scenes.optics.color import srgb_decode, srgb_encode
from lightmeter.truth import Truth

SIZE = (96, 96)
SMALL = (64, 64)
"""Of the whole library's frames: each pixel has its noise and its approximations, and half as many pixels do."""


# Images are kept, and no truth: every kernel holds the materials and lights of all worlds that are alive, and with
# those of the whole library it takes three times as long to compile.


@cache
def truth(name: str, size: tuple[int, int] = SIZE) -> np.ndarray:
    """8 batches of 8 samples a pixel."""
    return np.stack(Truth(load(name), size, Budget(64), 0).reference.batches)


@cache
def traced(name: str, size: tuple[int, int] = SIZE) -> np.ndarray:
    """What another path tracer would hand in: 64 samples a pixel, independent of the truth's."""
    return Truth(load(name), size, Budget(64), 0).path_traced(64, 1)


def renderer(scene: Scene, choice: Choice | None = None, size: tuple[int, int] = SIZE) -> Renderer:
    return Renderer(Device(), compile_plan(scene, effects(), choice), size)


@cache
def background(name: str, size: tuple[int, int] = SIZE) -> np.ndarray:
    return renderer(load(name), size=size).capture(terms=False).points.shape < 0


def found(
    name: str, image: np.ndarray, alpha: np.ndarray | None = None, size: tuple[int, int] = SIZE
) -> dict[str, dict[str, float]]:
    """Fault to its size."""
    faults = find_faults(image, truth(name, size), alpha=alpha, background=background(name, size))
    return {fault.name: dict(fault.size) for fault in faults}


@pytest.mark.parametrize("name", library.names())
def test_right_frames_raise_none(name):
    assert found(name, traced(name, SMALL), size=SMALL) == {}
    assert found(name, renderer(load(name), size=SMALL).render().radiance, size=SMALL) == {}


@pytest.mark.parametrize("name", ["cornell-box", "grid-sun", "posts", "torus"])
@pytest.mark.parametrize("without", ["shadow_map", "constant_ambient"])
def test_a_frame_that_lacks_a_term_is_no_frame_of_another_exposure(name, without):
    """Of scenes where what lacks lacks in places. Where it lacks everywhere alike it is a factor, and is named."""
    assert found(name, renderer(load(name), Choice(without=(without,))).render().radiance) == {}


@pytest.mark.parametrize("name", ["torus", "posts", "cornell-box"])
@pytest.mark.parametrize(("left_right", "up_down"), [(True, False), (False, True), (True, True)])
def test_a_flip(name, left_right, up_down):
    image = traced(name)[:: -1 if up_down else 1, :: -1 if left_right else 1]
    assert found(name, image) == {"flip": {"left_right": left_right, "up_down": up_down}}


FINER = 4
"""Samples to a side of a pixel, of an image that is shifted by parts of pixels."""


@cache
def fine(name: str) -> np.ndarray:
    """The scene path traced with `FINER` times the pixels."""
    size = (FINER * SIZE[0], FINER * SIZE[1])
    return Truth(load(name), size, Budget(64), 0).path_traced(8, 7)


def shifted(name: str, right: float, down: float) -> np.ndarray:
    """The box-filtered image, its content moved by quarters of pixels."""
    moved = np.roll(fine(name), (round(down * FINER), round(right * FINER)), axis=(0, 1))
    return moved.reshape(SIZE[1], FINER, SIZE[0], FINER, 3).mean(axis=(1, 3))


@pytest.mark.parametrize("name", ["torus", "posts", "cornell-box"])
@pytest.mark.parametrize(("right", "down"), [(0.5, 0.0), (0.0, -0.5), (1.0, 2.0), (-3.0, 0.5)])
def test_a_shift(name, right, down):
    """Found to a tenth of a pixel: an edge is placed to a third of one by 64 noisy samples, and ten of them average to
    that."""
    size = found(name, shifted(name, right, down))
    assert set(size) == {"shift"}
    assert size["shift"]["right"] == pytest.approx(right, abs=0.1)
    assert size["shift"]["down"] == pytest.approx(down, abs=0.1)


@pytest.mark.parametrize("name", ["torus", "posts", "cornell-box"])
def test_a_shift_of_a_real_time_frame(name):
    """Rendered with its samples elsewhere: to sample further left moves the picture to the right.

    Without anti-aliasing each edge falls to either side of its place by up to half a pixel.
    """
    made = renderer(load(name))
    made.offsets = np.array([[-1.0, -2.0]])
    size = found(name, made.render().radiance)
    assert set(size) == {"shift"}
    assert size["shift"]["right"] == pytest.approx(1.0, abs=0.25)
    assert size["shift"]["down"] == pytest.approx(2.0, abs=0.25)


@pytest.mark.parametrize(
    ("name", "percent"), [("torus", 2.0), ("torus", -2.0), ("cornell-box", 2.0), ("cornell-box", -2.0), ("posts", 5.0)]
)
def test_another_field_of_view(name, percent):
    """At the border of 96 pixels 2 % are a pixel, and a fifth of one is 0.4 %."""
    scene = load(name)
    wider = 2 * np.arctan(np.tan(scene.camera.yfov / 2) * (1 + percent / 100))
    other = replace(scene, camera=replace(scene.camera, yfov=float(wider)))
    size = found(name, Truth(other, SIZE, Budget(64), 0).path_traced(64, 3))
    assert set(size) == {"field_of_view"}
    assert size["field_of_view"]["horizontal"] == pytest.approx(percent, abs=0.4)
    assert size["field_of_view"]["vertical"] == pytest.approx(percent, abs=0.4)


@pytest.mark.parametrize("name", ["torus", "posts", "cornell-box"])
@pytest.mark.parametrize("factor", [1.5, 0.8, 4.0])
def test_an_exposure(name, factor):
    """Both sides have the noise of 64 samples: single pixels scatter by some 10 %, their most common ratio far less."""
    size = found(name, traced(name) * np.float32(factor))
    assert set(size) == {"exposure"}
    assert size["exposure"]["factor"] == pytest.approx(factor, rel=0.03)


@pytest.mark.parametrize("name", ["torus", "posts", "cornell-box"])
@pytest.mark.parametrize(("curve", "exponent"), [(srgb_encode, 1 / 2.2), (srgb_decode, 2.2)])
def test_a_transfer_curve_too_many_or_too_few(name, curve, exponent):
    """sRGB is a power law of 1/2.2 on the whole, and steeper in the dark: a tenth of the exponent is left for that."""
    size = found(name, curve(np.clip(traced(name), 0, 1)).astype(np.float32))
    assert "transfer" in size
    assert size["transfer"]["exponent"] == pytest.approx(exponent, rel=0.1)
    assert set(size) == {"transfer"}


def test_colours_that_were_multiplied_by_alpha():
    """The torus is handed in as half there; the scene says that it is opaque."""
    on_torus = renderer(load("torus")).capture(terms=False).points.shape == 1
    alpha = np.where(on_torus, 0.5, 1.0).astype(np.float32)
    size = found("torus", traced("torus") * alpha[..., None], alpha)
    assert set(size) == {"alpha"}
    assert size["alpha"]["pixels"] == pytest.approx(on_torus.sum(), rel=0.05)


def test_a_background_that_is_missing():
    name = "metal-rough-grid"
    assert background(name).any()
    size = found(name, np.where(background(name)[..., None], 0, traced(name)))
    assert set(size) == {"background"}


@pytest.mark.parametrize("name", ["posts"])
def test_correction_undoes_what_was_found(name):
    """A shift of whole pixels and an exposure: what remains is the resampling's blur and the exposure's own error."""
    image = np.roll(traced(name) * np.float32(2), (2, -3), axis=(0, 1))
    faults = find_faults(image, truth(name), background=background(name))
    assert {fault.name for fault in faults} == {"shift", "exposure"}
    inner = (slice(8, -8), slice(8, -8))
    mended = correct(image, faults)[inner]
    assert np.abs(mended - traced(name)[inner]).mean() < 0.1 * np.abs(image[inner] - traced(name)[inner]).mean()
