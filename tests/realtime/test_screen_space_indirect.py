"""Screen-space indirect light in a groove that the camera sees all of, where it has a closed form."""

import math

import numpy as np
import pytest

from lightmeter.realtime.graph import Choice
from lightmeter.scenes.model import DirectionalLight, Material, Mesh, Shape

from .small_scenes import LAMP, camera, facing, renderer, scene_of

GREY = Material("grey", (0.5, 0.5, 0.5), specular=0.0)
SUN = DirectionalLight("sun", (0.0, 0.0, -1.0), (2.0, 2.0, 2.0))
SIZE = (192, 48)


def side(sign: float) -> Shape:
    """One side of the groove: it rises towards the camera at 45° from the x axis, up the picture or down."""
    corners = np.array([[-4, 0, 0], [4, 0, 0], [4, sign, 1], [-4, sign, 1]], np.float32)
    turns = [[0, 1, 2], [0, 2, 3]] if sign > 0 else [[0, 2, 1], [0, 3, 2]]
    return Shape("side", Mesh(corners, np.array(turns)), GREY)


def groove():
    """Seen from straight above, as the sun does: the picture is 2 m high and shows both sides whole."""
    return scene_of(side(1.0), side(-1.0), view=camera(), lights=(SUN,))


def indirect(device, scene, size=SIZE, **knobs) -> np.ndarray:
    """What the effect gives, (H, W, 3)."""
    choice = Choice(use=("screen_space_indirect",), settings={"screen_space_indirect": knobs})
    return renderer(device, scene, size, choice).capture().frame["indirect"]


def exact() -> np.ndarray:
    """(H,) ρ·F·L down the picture, for a groove without ends.

    L = ρ/π·E·cos 45°. A point x from the crease sees the other side, D wide, from the crease (its own plane) to the
    edge, whose direction has the sine x/√(x² + D²) with the normal; a strip without ends has F = ½·(sin α₁ − sin α₂).
    """
    y = np.abs((np.arange(SIZE[1]) + 0.5) / SIZE[1] * 2 - 1)
    factor = 0.5 * (1 - y / np.sqrt(y**2 + 1))
    return 0.5 * factor * 0.5 / math.pi * 2.0 * math.sqrt(0.5)


def errors(device, **knobs) -> np.ndarray:
    """Relative errors down the middle of the picture."""
    middle = indirect(device, groove(), radius=4.0, **knobs)[:, SIZE[0] // 2 - 8 : SIZE[0] // 2 + 8, 0].mean(axis=1)
    return middle / exact() - 1


def test_a_groove_meets_its_closed_form_as_slices_and_steps_grow(device):
    """The ends that the groove has beyond 4 m take off up to ½·(1 − 4/√(16 + 2)) = 3 % of what an edge sees.

    Half a pixel is up to 2.5 % of F: a window of 4 × 4 lies half a pixel off, and the last place on a way up to a pixel
    before the picture's edge. Within two pixels of the crease a pixel is a large part of the way to the other side:
    these rows are left out.
    """
    away = np.abs(np.arange(SIZE[1]) + 0.5 - SIZE[1] / 2) > 2
    coarse, fine = errors(device, slices=1, steps=4), errors(device, slices=8, steps=64)
    assert np.sqrt(np.mean(fine[away] ** 2)) < 0.03 + 2 * 0.025
    assert np.sqrt(np.mean(fine[away] ** 2)) < np.sqrt(np.mean(coarse[away] ** 2)) / 2


def test_a_short_reach_sees_less(device):
    near, far = (indirect(device, groove(), radius=radius).mean() for radius in (0.1, 1.0))
    assert 0.05 * far < near < 0.8 * far


def test_what_shines_by_itself_is_no_scattered_light(device):
    """A glowing side lights the other as `direct`, which is another effect's."""
    glow = Material("glow", (0.0, 0.0, 0.0), specular=0.0, emissive=(5.0, 5.0, 5.0))
    dark, shining = side(1.0), Shape("glow", side(-1.0).mesh, glow)
    assert indirect(device, scene_of(dark, shining, view=camera())).max() == 0


def test_it_costs_nothing_where_one_flat_shape_is_alone(device):
    plan = renderer(device, scene_of(facing(GREY), lights=(LAMP,)), choice=Choice(use=("screen_space_indirect",))).plan
    assert "screen_space_indirect" not in plan.effects
    assert not plan.reads_scattered


@pytest.mark.parametrize("tile", [1, 4])
def test_it_reads_the_same_light_in_the_frame_and_in_the_measurement(device, tile):
    """The frame less what the terms by themselves add up to."""
    choice = Choice(use=("screen_space_indirect",), settings={"screen_space_indirect": {"tile": tile}})
    maker = renderer(device, groove(), SIZE, choice)
    radiance, capture = maker.render().radiance, maker.capture()
    shadow = capture.visibility.get(0, 1.0)
    np.testing.assert_allclose(radiance, capture.direct[0] * shadow + capture.frame["indirect"], rtol=1e-4, atol=1e-5)
