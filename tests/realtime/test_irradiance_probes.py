"""Irradiance probes: in a sphere that is lit alike all over, against closed forms; and where they leak."""

import math
from collections import Counter

import numpy as np
import pytest

from lightmeter.realtime.effect import EffectError
from lightmeter.realtime.effects.irradiance_probes.baking import cosine_weights
from lightmeter.realtime.effects.irradiance_probes.grid import Grid
from lightmeter.realtime.graph import Choice
from lightmeter.realtime.shadows.views import cube_views
from lightmeter.scenes import shapes
from lightmeter.scenes.model import Material, Mesh, PointLight, Shape

from .small_scenes import LAMP, camera, facing, moved, renderer, scene_of

GREY = Material("grey", (0.5, 0.5, 0.5), specular=0.0)
CENTRAL = PointLight("lamp", (0.0, 0.0, 0.0), (math.pi, math.pi, math.pi))
SEGMENTS = 48


def ball(*others: Shape):
    """The inside of a unit sphere with a lamp in its middle: direct light of radiance ρ everywhere."""
    sphere = shapes.sphere(1.0, SEGMENTS)
    wall = Shape("wall", Mesh(sphere.positions, sphere.triangles[:, ::-1]), GREY)
    return scene_of(wall, *others, view=camera((0.0, 0.0, 0.4), (0.0, 0.0, -1.0), yfov=1.0), lights=(CENTRAL,))


def made(device, scene, size=(16, 16), **knobs):
    """A renderer with probes."""
    choice = Choice(use=("irradiance_probes",), settings={"irradiance_probes": {"size": 8, "ambient": 0.0, **knobs}})
    return renderer(device, scene, size, choice)


def indirect(device, scene, **knobs) -> np.ndarray:
    """What the effect gives, (H, W, 3)."""
    return made(device, scene, **knobs).capture().frame["indirect"]


@pytest.mark.parametrize("weights", ["trilinear", "facing"])
def test_in_a_sphere_lit_alike_a_bounce_is_its_closed_form(device, weights):
    """Every probe sees the radiance ρ·I/π = ρ in every direction, so ρ² is scattered: 0.25.

    A facet's middle is nearer to the lamp than its corners by up to (π/48)²/2 = 0.2 %, twice for the square.
    """
    found = indirect(device, ball(), spacing=0.5, weights=weights)
    np.testing.assert_allclose(found, 0.25, rtol=2 * (math.pi / SEGMENTS) ** 2)


def test_an_axis_takes_two_thirds_of_a_cosine(device):
    """∫ cos²θ/π dω over a hemisphere is 2/3; of the other axes ∫ max(x, 0)·max(y, 0)/π dω is 2/(3π)."""
    scene, place = ball(), np.array([0.1, 0.0, -0.2])
    size = 32
    matrices = cube_views(scene, place, size, border=0).matrices
    weights = cosine_weights(matrices, place, size)
    # The radiance max(ω·y, 0) at the texels' middles, by unprojecting them in the test's own way.
    across = (np.arange(size) + 0.5) / size * 2 - 1
    radiance = np.zeros((6, size, size))
    for face, matrix in enumerate(matrices):
        right, up, forward = matrix[0, :3], matrix[1, :3], matrix[3, :3]
        for row, y in enumerate(across):
            for column, x in enumerate(across):
                ray = forward + x * right / (right @ right) + y * up / (up @ up)
                radiance[face, row, column] = max(ray[1] / np.linalg.norm(ray), 0.0)
    found = np.einsum("afyx,fyx->a", weights, radiance)
    np.testing.assert_allclose(found, [2 / (3 * np.pi)] * 2 + [2 / 3, 0] + [2 / (3 * np.pi)] * 2, atol=2e-3)


def test_each_axis_takes_what_lies_its_way(device):
    """A floor, a back wall and a right one, with a lamp between: light comes from −y, −z and +x."""
    floor = Shape("floor", shapes.plane(2.0, 2.0), GREY, moved(y=-1.0))
    turned = np.eye(4)[[2, 1, 0, 3]] * np.array([-1.0, 1.0, -1.0, 1.0])
    right = Shape("right", shapes.rectangle(2.0, 2.0), GREY, moved(x=1.0) @ turned)
    back = Shape("back", shapes.rectangle(2.0, 2.0), GREY, moved(z=-1.0))
    scene = scene_of(floor, right, back, view=camera((0.0, 0.0, 5.0)), lights=(CENTRAL,))
    maker = made(device, scene, spacing=1.0)
    (found,) = maker._passes["irradiance_probes"].own.baked[..., 0].T
    assert found[[1, 2, 4]].max() < 0.35 * found[[0, 3, 5]].min()
    np.testing.assert_allclose(found[[0, 3, 5]], found[0], rtol=0.01)


def test_they_are_baked_once(device):
    maker = made(device, ball(), spacing=1.0)
    assert maker.baking.milliseconds["irradiance_probes"] > 0
    before = Counter(device.counts)
    maker.draw()
    frame = device.counts["draws"] - before["draws"]
    without = renderer(device, ball(), (16, 16), Choice(without=("constant_ambient",)))
    before = Counter(device.counts)
    without.draw()
    assert frame == device.counts["draws"] - before["draws"] + 1


def test_light_leaks_through_a_screen_as_far_as_a_cell_reaches(device):
    """A wall that faces a screen, whose other side is lit: no light of one bounce comes here.

    The probes stand at the middles of cells: a single one lies on the lit side, of three layers none that counts does.
    """
    black = Material("black", (0.0, 0.0, 0.0), specular=0.0, double_sided=True)
    lit = Shape("lit", shapes.rectangle(2.0, 2.0), GREY, moved(z=2.0) @ np.diag([-1.0, 1.0, -1.0, 1.0]))
    screen = Shape("screen", shapes.rectangle(3.0, 3.0), black, moved(z=0.8))
    lamp = PointLight("lamp", (0.0, 0.0, 1.4), (3.0, 3.0, 3.0))
    view = camera((0.0, 0.0, 0.7), (0.0, 0.0, 0.0), yfov=1.0)
    scene = scene_of(facing(GREY, 2.0, 2.0), lit, screen, view=view, lights=(lamp,))
    wide, narrow = (indirect(device, scene, spacing=spacing, weights="trilinear") for spacing in (1.0, 0.25))
    assert wide.mean() > 0.003
    assert narrow.max() == 0


def test_a_buried_probe_is_left_out(device):
    """One in the middle, within a solid block that it sees only the backs of."""
    block = Shape("block", shapes.box(0.3, 0.3, 0.3), GREY)
    maker = made(device, ball(block), spacing=0.4)
    kept = maker._passes["irradiance_probes"].own.baked
    grid = Grid.of(maker.plan.scene, 0.4)
    assert tuple(grid.counts) == (3, 3, 3)
    assert kept[0, :, 3].tolist().count(0.0) == 1 and kept[0, 13, 3] == 0


def test_a_grid_fills_the_scene_and_has_an_end():
    scene = scene_of(facing(GREY, 4.0, 2.0))
    grid = Grid.of(scene, 0.25)
    assert tuple(grid.counts) == (4, 2, 1)
    np.testing.assert_allclose(grid.places()[0], [-1.5, -0.5, 0.0], atol=1e-6)
    np.testing.assert_allclose(grid.places()[-1], [1.5, 0.5, 0.0], atol=1e-6)
    with pytest.raises(EffectError, match=r"irradiance_probes.spacing: 0.03 makes \d+ probes, expected 4096 at most"):
        Grid.of(ball(), 0.03)


def test_it_costs_nothing_where_nothing_is_lit_or_nothing_scatters(device):
    dark = scene_of(facing(GREY), facing(GREY, 1.0, 1.0, moved(z=0.5)))
    for scene in (dark, scene_of(facing(GREY), lights=(LAMP,))):
        plan = renderer(device, scene, choice=Choice(use=("irradiance_probes",))).plan
        assert "irradiance_probes" not in plan.effects
