"""A planar mirror against a path-traced one: nothing is approximate there, so the error closes to noise."""

import numpy as np

from lightmeter.groundtruth.oracles import find
from lightmeter.groundtruth.world import World
from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.mse import mse
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes import shapes
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.model import Camera, Material, PointLight, Scene, Shape

BATCHES, SPP = 8, 32


def small_scene() -> Scene:
    """A metal floor as smooth as materials can be (α = 10⁻³), which shows nothing but one matt wall.

    The path length of 3 ends where the mirror's picture does: with direct light on what it shows. The wall covers the
    whole reflection and its light varies slowly, so that the lobe costs little: half of it comes from within 10⁻³ rad,
    and GGX's tail takes α²/(α² + tan²θ) of it from beyond θ (1 % from beyond 0.6°, 0.01 % from beyond 6°), as much from
    either side. Below 10⁻³ of the mean is where a mirror is; one pixel aside is 35 times that.
    """
    metal = Material("metal", (0.9, 0.8, 0.7), metallic=1.0, roughness=0.0)
    clay = Material("clay", (0.6, 0.5, 0.4), specular=0.0)
    behind = np.eye(4)
    behind[:3, 3] = 0.0, 0.0, -2.0
    return Scene(
        "mirror",
        (
            Shape("floor", shapes.plane(2.0, 2.0), metal),
            Shape("wall", shapes.rectangle(40.0, 40.0), clay, behind),
        ),
        Camera("camera", look_at((0.0, 1.0, 2.5), (0.0, 0.0, 0.0)), yfov=0.5, near=0.1, far=50.0),
        (PointLight("lamp", (0.5, 2.0, 1.5), (20.0, 20.0, 20.0)),),
        max_depth=3,
    )


def test_a_planar_mirror_closes_to_noise():
    scene = small_scene()
    settings = {"planar_mirror": {"ambient": 0.0}}
    choice = Choice(use=("planar_mirror",), without=("shadow_map", "supersampling"), settings=settings)
    capture = Renderer(Device(), compile_plan(scene, effects(), choice), (48, 48)).capture()
    world, oracle = World.of(scene), find("indirect")
    truth = [oracle.evaluate(world, capture.points, spp=SPP, seed=11, batch=batch) for batch in range(BATCHES)]
    mirror = capture.points.shape == 0
    assert mirror.sum() > 500
    got = [capture.frame["indirect"][mirror][None]]
    found = mse(Comparison(got, [image[mirror][None] for image in truth]))
    mean = float(np.mean([image[mirror] for image in truth]))
    assert mean > 0.05
    assert found.low <= 0 <= found.high
    assert found.value <= (1e-3 * mean) ** 2
    aside = [np.roll(capture.frame["indirect"], 1, axis=1)[mirror][None]]
    assert mse(Comparison(aside, [image[mirror][None] for image in truth])).low > (1e-2 * mean) ** 2
