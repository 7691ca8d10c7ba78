"""An effect knows no length but its knobs in metres: where those shrink with the scene, the frame is the same."""

import numpy as np
import pytest

from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes import shapes
from lightmeter.scenes.model import Material, Scene
from lightmeter.scenes.moving import scaled
from lightmeter.scenes.stiff.case import at, room
from lightmeter.scenes.stiff.materials import MIRROR

SMALLER = 2.0**-8
SAME = 1e-5
"""Of the mean. A power of two rounds nothing; constants that guard a division, and the driver's exp, move last bits."""
OTHERS = (
    "shadow_map", "cascaded_shadow_map", "exponential_shadow_map", "moment_shadow_map", "variance_shadow_map", "pcss",
    "packed_surface", "screen_space_indirect", "ltc_area_light",
)  # fmt: skip
LENGTHS = {e.name: [k for k in e.knobs if k.unit == "m"] for e in effects().values()}
BLAMED = {"gtao", "ssao"}
"""What a default in metres makes another effect in a scene of another size: see docs/stability-scenes.md."""


def bright_room() -> Scene:
    """With a lamp of some area, and a mirror at the back."""
    lamp = Material("lamp", emissive=(8.0, 8.0, 8.0))
    return room(
        at("lamp", shapes.rectangle(0.4, 0.4), (0.9, 1.0, 0.9), lamp),
        at("back", shapes.rectangle(4.0, 3.0), (0.0, 1.5, -2.0), MIRROR),
    )


def changed(name: str, shrink: bool) -> float:
    """RMS of a frame less that of the small scene, over its mean; with or without the effect's lengths shrunk."""
    frames = []
    for by in (1.0, SMALLER):
        lengths = {k.name: k.default * by for k in LENGTHS[name] if k.default} if shrink else {}
        plan = compile_plan(scaled(bright_room(), by), effects(), Choice(use=(name,), settings={name: lengths}))
        assert name in plan.effects
        frames.append(Renderer(Device(), plan, (16, 16)).render().radiance.astype(np.float64))
    return float(np.sqrt(np.mean((frames[1] - frames[0]) ** 2)) / frames[0].mean())


@pytest.mark.parametrize("name", sorted(BLAMED | set(OTHERS)))
def test_a_frame_shrinks_with_its_lengths(name):
    assert changed(name, shrink=True) < SAME


@pytest.mark.parametrize("name", sorted(BLAMED))
def test_a_radius_in_metres_is_to_blame(name):
    assert {"radius"} <= {k.name for k in LENGTHS[name]}
    assert changed(name, shrink=False) > 1e-3
