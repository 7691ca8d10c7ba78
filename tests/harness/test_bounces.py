"""Virtual lights against the path tracer's single bounce, in rooms where every point sees every other."""

import math

import numpy as np
import pytest

from lightmeter.bounce_errors import bounce_errors
from lightmeter.options import Budget
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes import shapes
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.model import Camera, Material, Mesh, PointLight, Scene, Shape
from lightmeter.sides import FramePoints
from lightmeter.truth import Truth

SIZE = (16, 16)
RHO = 0.5
LAMP = np.array([0.2, 0.3, 0.1])
INTENSITY = 5.0


@pytest.fixture(scope="module")
def truth():
    """A cube of 2 m with a lamp in it; the camera sees the middle of a wall, no nearer than 0.3 m to its edges."""
    box = shapes.box(2.0, 2.0, 2.0)
    room = Mesh(box.positions, box.triangles[:, ::-1])
    grey = Material("grey", (RHO,) * 3, specular=0.0)
    camera = Camera("test", look_at((0.0, 0.0, 0.9), (0.0, 0.0, -1.0)), yfov=2 * math.atan(0.7 / 1.9))
    lamp = PointLight("lamp", tuple(LAMP), (INTENSITY,) * 3)
    return Truth(Scene("room", (Shape("room", room, grey),), camera, (lamp,)), SIZE, Budget(spp=1024))


def found(truth, **knobs):
    """The effect against each truth, and its renderer's points."""
    settings = {"virtual_lights": {"clamp": 0.0, "resolution": 256, **knobs}}
    plan = compile_plan(truth.scene, effects(), Choice(use=("virtual_lights",), settings=settings))
    renderer = Renderer(Device(), plan, SIZE)
    at = FramePoints.of(renderer, truth)
    return {bounce.bounces: bounce for bounce in bounce_errors(renderer, truth, at)}, at.points


def spread_of_one_ray(points) -> tuple[np.ndarray, np.ndarray]:
    """Mean and standard deviation over the lamp's rays of what one that stands for all of them gives each point.

    A ray carries 4π·I; where it meets the wall it leaves ρ/π of that, and the point turns ρ/π of what arrives into
    radiance. In float64, by the room's own walls: the renderer has no part in it.
    """
    index = np.arange(4096)
    z, turn = 1 - (2 * index + 1) / 4096, 2 * np.pi * ((index + 0.3) * (math.sqrt(5) - 1) / 2 % 1)
    ray = np.stack([np.sqrt(1 - z**2) * np.cos(turn), np.sqrt(1 - z**2) * np.sin(turn), z], axis=1)
    distance = (np.where(ray > 0, 1.0, -1.0) - LAMP) / ray
    axis = np.argmin(distance, axis=1)
    ends = LAMP + ray * distance[index, axis][:, None]
    normals = -np.eye(3)[axis] * np.sign(ends[index, axis])[:, None]
    x, n = points.position.reshape(-1, 1, 3).astype(np.float64), points.normal.reshape(-1, 1, 3).astype(np.float64)
    offset = ends - x
    square = np.sum(offset**2, axis=2)
    towards = np.maximum(np.sum(offset * n, axis=2), 0) * np.maximum(-np.sum(offset * normals, axis=2), 0)
    each = 4 * np.pi * INTENSITY * (RHO / np.pi) ** 2 * towards / square**2
    return each.mean(axis=1), each.std(axis=1)


def test_virtual_lights_converge_to_one_bounce_as_their_number_grows(truth):
    """Root mean square over the picture: no more than N independent rays would err by, σ/√N with σ by quadrature.

    Rays of a lattice err by less, and by less than half as much when there are four times as many. A hundredth of the
    mean is added for what does not fall with N: a map of 256 texels over 2 m places a light within 4 mm, √(1/6)·8 mm =
    3 mm of its ray's end by root mean square, at no less than 0.3 m.
    """
    errors = {}
    for lights in (64, 256, 1024):
        bounces, points = found(truth, lights=lights)
        mean, sigma = spread_of_one_ray(points)
        errors[lights] = bounces[1].rmse
        assert errors[lights].high <= math.sqrt(np.mean(sigma**2) / lights) + 0.01 * mean.mean(), errors
    assert errors[256].high < errors[64].value / 2
    assert errors[1024].high < errors[64].value / 4
    assert bounces[1].share.value == pytest.approx(1, abs=0.01)
    assert bounces[1].energy.value == pytest.approx(1, abs=0.01)


def test_a_clamp_keeps_it_from_converging(truth):
    errors = [found(truth, lights=1024, clamp=clamp)[0][1] for clamp in (0.0, 0.3)]
    assert errors[1].rmse.value > 5 * errors[0].rmse.value
    assert errors[1].missing.value > 5 * errors[1].leaked.value


def test_a_second_bounce_meets_the_truth_of_two_and_falls_short_of_all(truth):
    """Of a grey room's light each bounce leaves about ρ: after two, ρ² of what is scattered is left."""
    bounces, _ = found(truth, lights=1024, bounces=2)
    assert bounces[2].energy.value == pytest.approx(1, abs=0.02)
    assert bounces[1].energy.value > 1.3
    assert bounces[None].energy.value < 0.9
