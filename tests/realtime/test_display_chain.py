"""The display chain: what the device draws is what the twins say, and glare and exposure come where they belong."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from lightmeter.display_chain import Chained
from lightmeter.realtime.discovery import effect, effects
from lightmeter.realtime.display import display_transform, twin_of
from lightmeter.realtime.graph import DISPLAY_TERMS, Choice, compile_plan
from lightmeter.realtime.pictures.codes import written
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.load import load
from lightmeter.scenes.metering import Metering

SIZE = 61, 43
"""Odd, so that halves and blocks do not fit."""


def weight(device) -> float:
    """What the weights of a bilinear lookup are rounded to: 8 bits in texture units (Vulkan's and Direct3D's least).

    llvmpipe has them in float32: a coordinate of a row of 61 pixels is rounded thrice to 2⁻²⁴ of it.
    """
    return 3 * 61 * 2.0**-24 if device.software else 2.0**-8


def picture() -> np.ndarray:
    """Noise, a gradient that tells up from down, and two lamps."""
    rng = np.random.default_rng(1)
    image = rng.gamma(1.0, 0.3, (SIZE[1], SIZE[0], 3)) + np.linspace(0, 1, SIZE[1])[:, None, None]
    image[8, 12] = [900.0, 500.0, 100.0]
    image[30, 50] = [10.0, 20.0, 40.0]
    return image.astype(np.float32)


def passes(device, name: str, metering: Metering | None = None, **settings):
    """The effect's passes and its knobs."""
    found = effect(name)
    knobs = found.settings(settings)
    camera = SimpleNamespace(metering=metering)
    stage = SimpleNamespace(device=device, size=SIZE, scene=SimpleNamespace(camera=camera))
    module = __import__(f"lightmeter.realtime.effects.{name}.passes", fromlist=["Passes"])
    return module.Passes(stage, knobs, found.folder), knobs


def uploaded(device, image: np.ndarray):
    alpha = np.ones((*image.shape[:2], 1), np.float32)
    data = np.ascontiguousarray(np.concatenate([image, alpha], axis=-1)[::-1], np.float32)
    return device.gl.texture(SIZE, 4, data.tobytes(), dtype="f4")


@pytest.mark.parametrize(
    ("name", "settings"),
    [
        ("gaussian_bloom", {}),
        ("gaussian_bloom", {"divisor": 1, "sigma": 0.05, "threshold": 0.0, "strength": 1.0}),
        ("gaussian_bloom", {"divisor": 8, "sigma": 0.2, "strength": 1.0}),
        ("mip_bloom", {}),
        ("mip_bloom", {"levels": 10, "spread": 0.8, "strength": 0.5}),
        ("lens_flare", {"strength": 1.0}),
        ("lens_flare", {"strength": 1.0, "halo": 0.0, "divisor": 1, "ghosts": 2, "chroma": 0.05}),
    ],
)
def test_glare_on_the_device_is_its_twin(device, name, settings):
    """A lookup's rounded weights move a lamp's light by as much of it at most, along a row and from row to row."""
    made, knobs = passes(device, name, **settings)
    image = picture()
    made.draw(uploaded(device, image))
    drawn = device.read(made.image)[..., :3].astype(np.float64)
    exact = twin_of(name, "glare")(image.astype(np.float64), knobs)
    added = np.abs(exact - image).max()
    assert added > 0.1
    assert np.abs(drawn - exact).max() <= 2 * weight(device) * added


@pytest.mark.parametrize("metering", [Metering(), Metering(darkest=0.2, brightest=0.1), Metering(floor=0.5)])
@pytest.mark.parametrize(
    ("name", "settings"),
    [
        ("histogram_exposure", {}),
        ("histogram_exposure", {"bins": 7, "stride": 1}),
        ("log_average_exposure", {}),
        ("log_average_exposure", {"side": 1}),
        ("log_average_exposure", {"side": 8}),
    ],
)
def test_a_metered_average_on_the_device_is_its_twin(device, metering, name, settings):
    made, knobs = passes(device, name, metering, **settings)
    image = picture()
    made.draw(uploaded(device, image))
    drawn = float(device.read(made.average)[0, 0, 0])
    exact = twin_of(name, "exposure")(image.astype(np.float64), knobs, metering)
    if bins := knobs.get("bins"):  # a pixel within rounding of a bin's edge may fall to either side
        width, pixels = (knobs["high"] - knobs["low"]) / bins, SIZE[0] * SIZE[1] / knobs["stride"] ** 2
        allowed = width / pixels
    else:  # neighbours differ by at most 12 stops
        allowed = 2 * 12 * weight(device)
    assert drawn == pytest.approx(exact, abs=allowed)


def test_a_frame_s_display_is_the_chain_of_its_radiance(device):
    """Half a code for rounding; glare's float32 moves a pixel by less than 0.1 of a code."""
    plan = compile_plan(load("lamps"), effects(), Choice(use=("lens_flare", "log_average_exposure")))
    frame = Renderer(device, plan, (96, 64)).render()
    assert frame.display is not None
    codes = Chained(plan, frame.radiance.astype(np.float64)).whole(()) * 255
    assert np.abs(frame.display - codes).max() <= 0.5 + 0.1
    unmetered = replace(plan.scene.camera, metering=None, aperture=None)
    other = compile_plan(replace(plan.scene, camera=unmetered), effects())
    assert np.abs(frame.display - display_transform(other)(frame.radiance) * 255).max() > 20


@pytest.mark.parametrize("dither", ["none", "ordered", "noise"])
def test_dithered_codes_are_the_twin_s(device, dither):
    """A code within float32's rounding of its threshold may be either: pow's 1e-5 of 255 codes, on both sides."""
    plan = compile_plan(load("posts"), effects(), Choice(settings={"srgb": {"dither": dither}}))
    frame = Renderer(device, plan, (64, 48)).render()
    codes = Chained(plan, frame.radiance.astype(np.float64)).whole(()) * 255
    assert (np.abs(codes - np.rint(codes)) < 1e-4).all()
    off = np.abs(frame.display - codes) > 0.5
    assert off.mean() <= 2 * 255e-5


def test_dither_keeps_the_mean_that_rounding_loses():
    """A grey of 100.3 codes: rounding is 0.3 off everywhere, 64 thresholds leave 1/128 at most."""
    grey = np.full((64, 64, 3), 100.3 / 255)
    for name, allowed in (("none", 0.3 + 1e-9), ("ordered", 1 / 128 + 1e-9), ("noise", 0.02)):
        found = written(grey, {"dither": name}) * 255
        assert abs(found.mean() - 100.3) <= allowed
        assert set(np.unique(np.rint(found))) == ({100} if name == "none" else {100, 101})


def test_reinhard_s_white_point_is_white():
    for on in ("luminance", "channels"):
        knobs = effect("reinhard").settings({"white": 3.0, "on": on})
        np.testing.assert_allclose(twin_of("reinhard", "tone")(np.full((1, 1, 3), 3.0), knobs), 1.0)
    ratio = twin_of("reinhard", "tone")(np.array([[[0.4, 0.2, 0.1]]]), effect("reinhard").settings({}))[0, 0]
    np.testing.assert_allclose(ratio / ratio[2], [4, 2, 1])


def test_order_and_need():
    plan = compile_plan(load("lamps"), effects(), Choice(use=("lens_flare",)))
    chain = [step for step in plan.steps if step.writes[0] in DISPLAY_TERMS]
    assert [(step.effect, step.reads) for step in chain] == [
        ("mip_bloom", ("radiance",)),
        ("lens_flare", ("glare",)),
        ("histogram_exposure", ("glare",)),
        ("narkowicz", ("exposure",)),
        ("srgb", ("tone",)),
    ]
    bare = compile_plan(load("posts"), effects(), Choice(use=("lens_flare", "mip_bloom", "histogram_exposure")))
    assert not {"lens_flare", "mip_bloom", "histogram_exposure"} & set(bare.effects)
    assert bare.why_absent("mip_bloom") == "the camera has no aperture to diffract at"
    assert bare.why_absent("histogram_exposure") == "the camera's exposure is set by hand"
