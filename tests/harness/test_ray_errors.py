"""What becomes of marched rays: each fate where it must be, and the squared error shared out among them."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.options import Budget
from lightmeter.ray_errors import ray_errors
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.reports.ray_content import FATES, ray_content, ray_line
from lightmeter.scenes import shapes
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.model import Camera, Material, PointLight, Scene, Shape
from lightmeter.sides import FramePoints
from lightmeter.truth import Truth

METAL = Material("metal", (0.9, 0.9, 0.9), metallic=1.0, roughness=0.0)
CLAY = Material("clay", (0.6, 0.5, 0.4), specular=0.0)
SIZE = (32, 32)


def at(x: float, y: float, z: float) -> np.ndarray:
    """A translation."""
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def mirror_scene(*more: Shape) -> Scene:
    """A wall that mirrors straight back: what it shows lies behind the camera, where a matt wall is."""
    behind = at(0.0, 0.0, 6.0) @ np.diag([-1.0, 1.0, -1.0, 1.0])
    return Scene(
        "mirror",
        (
            Shape("mirror", shapes.rectangle(2.0, 2.0), METAL),
            Shape("behind", shapes.rectangle(20.0, 20.0), CLAY, behind),
            *more,
        ),
        Camera("camera", look_at((0.0, 0.0, 4.0), (0.0, 0.0, 0.0)), yfov=0.6, near=0.1, far=50.0),
        (PointLight("lamp", (0.0, 1.5, 3.0), (20.0, 20.0, 20.0)),),
        max_depth=3,
    )


def errors_of(scene: Scene, march: str, thickness: float = 0.005):
    """The one effect's."""
    knobs = {"march": march, "fallback": "none", "ambient": 0.0, "thickness": thickness}
    choice = Choice(
        use=("screen_space_reflections",),
        without=("shadow_map", "supersampling"),
        settings={"screen_space_reflections": knobs},
    )
    renderer = Renderer(Device(), compile_plan(scene, effects(), choice), SIZE)
    truth = Truth(scene, SIZE, Budget(spp=64))
    (error,) = ray_errors(renderer, truth, FramePoints.of(renderer, truth))
    return error


@pytest.mark.parametrize("march", ["linear", "hierarchical"])
def test_what_lies_behind_the_camera_is_off_the_screen(march):
    """Nothing is seen but the mirror: its rays come back past the camera. All of the error is theirs."""
    error = errors_of(mirror_scene(), march)
    assert error.parts["left"].pixels == sum(part.pixels for part in error.parts.values())
    assert error.parts["left"].share.value == pytest.approx(1.0)
    assert error.rmse.value > 0.02


@pytest.mark.parametrize("march", ["linear", "hierarchical"])
def test_what_lies_behind_something_is_hidden(march):
    """On their way out of the picture rays from the right pass half a metre and more behind a card near the camera.

    That is more than a surface is taken to be thick (5 ‰ of 29 m).
    """
    card = Shape("card", shapes.rectangle(0.2, 0.5), CLAY, at(0.35, 0.0, 2.5))
    error = errors_of(mirror_scene(card), march)
    assert error.parts["hidden"].pixels > 10
    assert error.parts["none"].pixels > 10  # the card itself mirrors nothing
    assert sum(part.share.value for part in error.parts.values()) == pytest.approx(1.0)
    assert error.parts["hidden"].share.value > 0.01
    name, line = ray_line(error)
    assert name == "rays of screen_space_reflections" and "hidden behind something" in line
    content = ray_content((error,))
    assert content is not None and len(content["rows"][0]["cells"]) == len(FATES)
    assert ray_content(()) is None


@pytest.mark.parametrize("march", ["linear", "hierarchical"])
def test_a_hit_is_wrong_where_the_truth_is_not_in_the_picture(march):
    """A mirror floor under a card: its front is seen and mirrored rightly, a thick surface is met in its stead.

    A card that faces the camera shows its front above the floor, and the floor mirrors its front. A card that lies flat
    shows its upper side; the floor mirrors the lower one, so that every ray that meets the card is wrong.
    """
    floor = Shape("floor", shapes.plane(6.0, 6.0), METAL)
    upright = Shape("card", shapes.rectangle(1.0, 1.0), CLAY, at(0.0, 0.52, 0.0))
    flat = Shape("card", shapes.plane(1.0, 1.0), replace(CLAY, double_sided=True), at(0.0, 0.6, 0.0))
    view = Camera("camera", look_at((0.0, 1.6, 3.0), (0.0, 0.2, 0.0)), yfov=0.7, near=0.1, far=50.0)
    shares = []
    for card in (upright, flat):
        scene = replace(mirror_scene(), shapes=(floor, card), camera=view)
        error = errors_of(scene, march, thickness=0.2)
        shares.append(error.parts["wrong"].pixels / (error.parts["wrong"].pixels + error.parts["met"].pixels))
    assert shares[0] < 0.25 < 0.75 < shares[1]


def test_an_effect_without_rays_has_no_verdict():
    scene = mirror_scene()
    renderer = Renderer(Device(), compile_plan(scene, effects(), Choice(use=("planar_mirror",))), SIZE)
    assert renderer.capture().verdicts == {}
