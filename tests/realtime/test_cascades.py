"""Cascades: where the field is cut, that every point is in its cascade's view, and what that gains."""

import numpy as np
import pytest

from lightmeter.realtime.discovery import effects
from lightmeter.realtime.effects.cascaded_shadow_map.cascades import cascades, split_depths
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.scenes import shapes
from lightmeter.scenes.load import load
from lightmeter.scenes.model import DirectionalLight, PointLight, Shape

from .small_scenes import WHITE, camera, moved, points, renderer, scene_of

SIZE = (64, 48)
SUN = DirectionalLight("sun", (0.6, -0.64, 0.48), (1, 1, 1))
GROUND = Shape("ground", shapes.plane(60, 60), WHITE)
LOOKING = {
    "level": camera((0, 1.7, 8), (0, 0.8, 0), yfov=0.9, far=200.0),
    "down": camera((0, 12, 0), (0, 0, 0), yfov=0.9),
    "up": camera((0, 0.4, 0), (0, 1.5, -2), yfov=1.2, far=200.0),
    "aslant": camera((3, 2, 4), (-4, 0.3, -9), yfov=0.5, far=200.0),
    "without perspective": camera((3, 4, 9), (0, 0.5, 0), ymag=2.0, far=200.0),
}


def post(x: float, z: float) -> Shape:
    """A post of 2 m."""
    return Shape("post", shapes.box(0.3, 2.0, 0.3), WHITE, moved(x, 1.0, z))


POSTS = tuple(post(x, z) for z in (4.0, 0.0, -6.0, -15.0) for x in (-1.5, 1.0))


def test_the_field_is_cut_by_the_practical_scheme():
    """Zhang et al. 2006: the mean of n·(f/n)^(i/m) and n + (f − n)·i/m, for equal parts of both."""
    assert split_depths(1.0, 16.0, 4, 1.0) == pytest.approx([1, 2, 4, 8, 16])
    assert split_depths(1.0, 16.0, 3, 0.0) == pytest.approx([1, 6, 11, 16])
    assert split_depths(1.0, 16.0, 2, 0.5) == pytest.approx([1, (4 + 8.5) / 2, 16])


@pytest.mark.parametrize("name", LOOKING)
@pytest.mark.parametrize("count", [1, 3, 4])
def test_every_point_that_is_seen_lies_in_its_cascade(device, name, count):
    """With a border for the filter, wherever in its pixel a point is sampled; and slices share out all depths."""
    scene = scene_of(GROUND, *POSTS, view=LOOKING[name], lights=(SUN,))
    border = 3
    found = cascades(scene, SUN, SIZE, 256, border, count, 0.5)
    assert len(found.views.matrices) == count
    used = set()
    for offset in ((0.0, 0.0), (0.5, -0.5), (-0.5, 0.5)):
        at = points(device, scene, SIZE, offset)
        position = np.append(at.position[at.hit].astype(np.float64), np.ones((at.hit.sum(), 1)), axis=1)
        chosen = np.sum((position @ found.depth)[:, None] > found.ends, axis=1)
        used |= set(chosen)
        clip = np.einsum("nij,nj->ni", found.views.matrices[chosen], position)
        assert np.abs(clip[:, 2]).max() < 1
        assert np.abs(clip[:, :2]).max() <= 1 - 2 * (border - 0.01) / 256
    assert used == set(range(count)) or name != "level"


def wrong(device, scene, **knobs) -> int:
    """Pixels of the ground whose visibility is not that of the geometry, ray by ray."""
    seen = renderer(device, scene, SIZE, Choice(use=("cascaded_shadow_map",), settings={"cascaded_shadow_map": knobs}))
    capture = seen.capture()
    ground = capture.points.shape == 0
    position = capture.points.position[ground].astype(np.float64)
    to_sun = -np.array(SUN.direction)
    dark = np.zeros(len(position), bool)
    for placed in scene.shapes[1:]:
        low, high = (end(placed.world.positions, axis=0) for end in (np.min, np.max))
        first, second = (low - position) / to_sun, (high - position) / to_sun
        enter, leave = np.minimum(first, second).max(axis=1), np.maximum(first, second).min(axis=1)
        dark |= (enter < leave) & (leave > 0)
    assert 50 < dark.sum() < dark.size / 2
    return int(np.sum(np.abs(capture.visibility[0][ground][:, 0] - ~dark) > 0.5))


def test_more_cascades_are_less_wrong(device):
    """Of one map a texel is 0.33 m, wider than a post; of four maps the nearest one's is 0.05 m."""
    scene = scene_of(GROUND, *POSTS, view=LOOKING["level"], lights=(SUN,))
    counts = [wrong(device, scene, resolution=128, filter="hard", cascades=count) for count in (1, 2, 4)]
    assert counts[0] > 2 * counts[1] > 2 * counts[2]
    assert wrong(device, scene, resolution=2048, filter="hard", cascades=4) < 10


def test_what_the_camera_does_not_see_casts_into_what_it_sees(device):
    """A tower behind and above the camera, outside of every slice."""
    tower = Shape("tower", shapes.box(1, 12, 1), WHITE, moved(-6, 6.0, -3.0))
    view = camera((0, 2, 0), (0, 0, 4.0), yfov=1.0)
    scene = scene_of(GROUND, tower, view=view, lights=(SUN,))
    assert not (points(device, scene, SIZE).shape == 1).any()
    assert wrong(device, scene, resolution=512, filter="hard") < 10


def test_a_camera_that_sees_nothing_is_no_error(device):
    view = camera((0, 2, 0), (0, 12, 0), yfov=0.5)
    scene = scene_of(GROUND, *POSTS, view=view, lights=(SUN,))
    choice = Choice(use=("cascaded_shadow_map",))
    assert (renderer(device, scene, SIZE, choice).capture().visibility[0] == 1).all()


def test_cascades_are_for_suns_alone():
    both = scene_of(GROUND, *POSTS, lights=(SUN, PointLight("p", (0, 3, 0), (1, 1, 1))))
    plan = compile_plan(both, effects(), Choice(use=("cascaded_shadow_map",)))
    assert plan.lights_of("cascaded_shadow_map") == (0,) and plan.lights_of("shadow_map") == (1,)
    plan = compile_plan(load("cornell-box"), effects(), Choice(use=("cascaded_shadow_map",)))
    assert plan.why_absent("cascaded_shadow_map") == "the scene has no light of the kinds it handles"
