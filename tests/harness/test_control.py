"""The control experiment: where direct light is the whole truth, the real-time frame must be the reference.

A mistake of convention (half a pixel, a mirrored axis, a missing π, sRGB taken for linear, a spot's falloff) shows
here as a difference far beyond noise and discretisation; each is planted once to see that it does.
"""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.groundtruth.batches import reference
from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.registry import measure_all
from lightmeter.realtime import geometry, shaders
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Image, Scene, SpotLight, Texture

GRID = 8
SIZE = (96, 96)
LARGEST_BIAS = 1e-4
"""Of the mean (issue's bound; a prototype reached 1e-5)."""

DECODING = 2.4 * 0.5 / 128
"""Relative error that a driver may make in decoding the sRGB code 128: half a code (Direct3D 11.3 functional
specification, 3.2.3.7); llvmpipe is off by 0.36 % there. It is part of the term `material`, not of a convention."""


def with_spot(scene: Scene) -> Scene:
    """The control scene under a spot whose rim crosses the sphere."""
    point = scene.lights[0]
    aim = -np.array(point.position) / np.linalg.norm(point.position)
    spot = SpotLight("spot", point.position, tuple(aim), point.intensity, np.radians(2.0), np.radians(9.0))
    return replace(scene, lights=(spot,))


def with_texture(scene: Scene) -> Scene:
    """The control scene with an sRGB texture of one colour: filtering plays no part, decoding does."""
    texture = Texture(Image(np.full((2, 2, 3), 128, np.uint8)), srgb=True)
    shape = scene.shapes[0]
    return replace(scene, shapes=(replace(shape, material=replace(shape.material, base_color_texture=texture)),))


def frame(scene: Scene) -> np.ndarray:
    """The real-time frame, supersampled."""
    choice = Choice(("cook_torrance", "supersampling", "texture_filtering"), settings={"supersampling": {"grid": GRID}})
    return Renderer(Device(), compile_plan(scene, effects(), choice), SIZE).render().radiance


def largest_nrmse(image: np.ndarray) -> float:
    """What a regular n × n grid may leave at silhouettes.

    A line across a pixel splits the grid's n rows at one place each, every split is off by at most half a sample:
    coverage is wrong by at most n·½/n² = 1/(2n). It matters in the pixels that a silhouette crosses.
    """
    inside = image.max(axis=2) > 0
    edge = np.zeros_like(inside)
    for axis in (0, 1):
        crossed = np.diff(inside, axis=axis)
        edge |= np.insert(crossed, 0, False, axis=axis) | np.insert(crossed, inside.shape[axis] - 1, False, axis=axis)
    return float(np.sqrt(edge.mean()) / (2 * GRID) * image.max() / image.mean())


def agrees(image: np.ndarray, batches: np.ndarray, decoding: float = 0.0) -> bool:
    """Whether the whole interval of the bias lies within the bound, and the error within noise and discretisation.

    Args:
        decoding: what the texture's decoding may add to either, relative.
    """
    found = measure_all(["relative_bias", "nrmse"], Comparison(image, batches))
    bias, error = found["relative_bias"], found["nrmse"]
    bound = LARGEST_BIAS + decoding
    # An error of the whole image by a factor is nrmse = factor · rms / mean.
    contrast = float(np.sqrt(np.mean(image.astype(np.float64) ** 2)) / image.mean())
    return -bound < bias.low and bias.high < bound and error.low <= largest_nrmse(image) + decoding * contrast


@pytest.fixture(scope="module")
def truths():
    """The references of the control scene and its two variants.

    The texture's may have twice the noise: what its decoding may err by is ninety times the largest bias.
    """
    scenes = {
        "point": (load("control"), 64),
        "spot": (with_spot(load("control")), 64),
        "texture": (with_texture(load("control")), 16),
    }
    return {name: (scene, reference(scene, SIZE, spp=spp, batches=16).batches) for name, (scene, spp) in scenes.items()}


@pytest.mark.parametrize(("name", "decoding"), [("point", 0.0), ("spot", 0.0), ("texture", DECODING)])
def test_the_frame_is_the_reference(truths, name, decoding):
    scene, batches = truths[name]
    assert agrees(frame(scene), batches, decoding)


def replace_glsl(monkeypatch, old: str, new: str) -> None:
    """Plant a mistake in every shader text that holds `old`."""
    read = shaders._read

    def planted(name, folder):
        return read(name, folder).replace(old, new)

    assert any(old in path.read_text() for path in shaders.SHARED.iterdir())
    monkeypatch.setattr(shaders, "_read", planted)


def test_half_a_pixel_is_caught(truths):
    scene, batches = truths["point"]
    image = frame(replace(scene, camera=shifted(scene)))
    assert not agrees(image, batches)


def shifted(scene: Scene):
    """The camera, moved so that its picture moves by half a pixel; the sphere is 2.2 m away."""
    matrix = scene.camera.matrix.copy()
    pixel = 2 * 2.2 * np.tan(scene.camera.yfov / 2) / SIZE[1]
    matrix[0, 3] += pixel / 2
    return replace(scene.camera, matrix=matrix)


def test_a_flipped_axis_is_caught(truths, monkeypatch):
    scene, batches = truths["point"]
    read = Device.read
    monkeypatch.setattr(Device, "read", lambda self, texture: read(self, texture)[::-1])
    assert not agrees(frame(scene), batches)


def test_a_missing_pi_is_caught(truths, monkeypatch):
    scene, batches = truths["point"]
    replace_glsl(monkeypatch, "diffuse_color(base_color, metallic) * (1.0 / PI)", "diffuse_color(base_color, metallic)")
    assert not agrees(frame(scene), batches)


def test_srgb_read_as_linear_is_caught(truths, monkeypatch):
    scene, batches = truths["texture"]
    monkeypatch.setattr(geometry, "GL_SRGB8_ALPHA8", None)
    assert not agrees(frame(scene), batches, DECODING)


def test_a_linear_spot_falloff_is_caught(truths, monkeypatch):
    scene, batches = truths["spot"]
    replace_glsl(monkeypatch, "return ramp * ramp;", "return ramp;")
    assert not agrees(frame(scene), batches)
