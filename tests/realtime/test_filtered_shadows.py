"""Shadow maps that are filtered before they are looked up: where light leaks, by how much, and where it does not."""

import numpy as np
import pytest
from scipy.optimize import linprog

from lightmeter.realtime.effects.moment_shadow_map.twin import least_before
from lightmeter.realtime.graph import Choice
from lightmeter.scenes import shapes
from lightmeter.scenes.model import DirectionalLight, Material, Shape, SpotLight, Texture

from .small_scenes import WHITE, camera, image, moved, renderer, scene_of
from .test_shadow_maps import ABOVE, BOX, FLOOR, LIGHTS, SPHERE, blocked, leaf, towards

FILTERED = ("variance_shadow_map", "exponential_shadow_map", "moment_shadow_map")
NOON = DirectionalLight("noon", (0.0, -1.0, 0.0), (1, 1, 1))
RESOLUTION = 256


def visibility_of(device, name, scene, size=(64, 64), **knobs):
    """The points, and the first light's visibility there by a technique."""
    seen = renderer(device, scene, size, Choice(use=(name,), settings={name: knobs})).capture()
    return seen.points, seen.visibility[0][..., 0].astype(np.float64)


@pytest.mark.parametrize("technique", FILTERED)
@pytest.mark.parametrize("name", LIGHTS)
def test_far_from_an_edge_it_is_lit_or_dark(device, technique, name):
    """One box over a floor. Around a point on the map the filter reads 1 + 1 texels (2.83 along the diagonal).

    Dark: the box is 0.4 m from the floor at least, of a depth of 7 m at most; the exponential lets e^(−80·0.4/7) = 0.01
    through, the others nothing where all depths are the box's. Lit: within the filter the floor is a plane through the
    point, moved away from it by half a texel's bias.
    """
    light = LIGHTS[name]
    scene = scene_of(FLOOR, BOX, view=ABOVE, lights=(light,))
    points, seen = visibility_of(device, technique, scene, resolution=RESOLUTION, blur=1)
    floor = points.shape == 0
    position = points.position[floor].astype(np.float64)
    direction, distance = towards(light, position)
    across = 2 / (RESOLUTION - 6) * np.where(np.isfinite(distance), distance, 0) + (7 / RESOLUTION) * np.isinf(distance)
    texel = across / direction[:, 1] * 3.5
    ring = [(np.cos(a) * r, 0, np.sin(a) * r) for a in np.arange(16) / 16 * 2 * np.pi for r in (0.5, 1.0)]
    around = [blocked(light, position + texel[:, None] * np.array(step)) for step in ring]
    dark, lit = np.all(around, axis=0), ~np.any(around, axis=0)
    if isinstance(light, SpotLight):
        lit &= -direction @ np.array(light.direction) > np.cos(light.outer)
    assert dark.sum() > 20 and lit.sum() > 400
    assert seen[floor][dark].max() < 0.01
    assert seen[floor][lit].min() > 0.98


@pytest.mark.parametrize("technique", FILTERED)
@pytest.mark.parametrize("name", ["directional", "spot", "point over a corner of its cube"])
def test_a_ball_hardly_shadows_its_own_front(device, technique, name):
    light = LIGHTS[name]
    speck = Shape("speck", shapes.rectangle(0.01, 0.01), WHITE, moved(0, -1.5, 0))
    scene = scene_of(SPHERE, speck, view=ABOVE, lights=(light,))
    points, seen = visibility_of(device, technique, scene, resolution=RESOLUTION)
    direction, _ = towards(light, points.position.astype(np.float64))
    lit = (points.shape == 0) & (np.sum(direction * points.normal, axis=-1) > 0.3)
    if isinstance(light, SpotLight):
        lit &= -direction @ np.array(light.direction) > np.cos(light.outer)
    assert lit.sum() > 150
    assert seen[lit].min() > 0.9


@pytest.mark.parametrize("technique", FILTERED)
@pytest.mark.parametrize("blur", [0, 1, 3])
def test_a_shadow_s_edge_is_as_wide_as_the_filter(device, technique, blur):
    """A sheet far above the floor: with two depths, all three give the share q that is not blocked.

    The map's texels hold the mean over 2r + 1 of them and the hardware interpolates: a ramp of 2r + 1 texels. Pixels
    are an eighth of a texel wide, and two of them decide.
    """
    x, seen = under_sheets(device, technique, (2.0, 0.0), blur=blur, bleeding=0.0)
    texel = 6 / RESOLUTION
    inside = x[(seen > 0.1) & (seen < 0.9)]
    assert np.ptp(inside) == pytest.approx(0.8 * (2 * blur + 1) * texel, abs=texel / 4)
    assert abs(np.interp(0.5, seen, x)) < 0.6 * texel
    assert seen[x < -(blur + 1.1) * texel].max() < 1e-3 and seen[x > (blur + 1.1) * texel].min() > 0.99


def sheets(*heights_and_edges) -> list[Shape]:
    """Half planes over the floor: each at a height, from x = −3 up to an edge."""
    return [
        Shape(f"sheet {h}", shapes.plane(edge + 3, 6), WHITE, moved((edge - 3) / 2, h, 0))
        for h, edge in heights_and_edges
    ]


def under_sheets(device, technique, *heights_and_edges, **knobs):
    """The visibility along x on the floor below half planes, at noon: x and the visibility, sorted."""
    if technique == "exponential_shadow_map":
        knobs.pop("bleeding", None)
    low = min(h for h, _ in heights_and_edges)
    view = camera((0.0, low * 0.9, 0.0), (0.0, 0.0, 0.0), ymag=0.2, near=0.01)
    wide = Shape("floor", shapes.plane(6, 6), WHITE)
    scene = scene_of(wide, *sheets(*heights_and_edges), view=view, lights=(NOON,))
    points, seen = visibility_of(device, technique, scene, size=(128, 128), resolution=RESOLUTION, **knobs)
    assert (points.shape == 0).all()
    x = points.position[..., 0].astype(np.float64).ravel()
    order = np.argsort(x, kind="stable")
    return x[order], seen.ravel()[order]


SHARES = np.linspace(0, 1, 2001)


def chebyshev(depths, weights, depth) -> np.ndarray:
    """The share of light that variance shadow maps let through where all of it is blocked."""
    mean = weights @ depths
    variance = weights @ depths**2 - mean**2
    return variance / (variance + (depth - mean) ** 2)


@pytest.mark.parametrize(("high", "low"), [(2.0, 0.5), (1.0, 0.8), (2.0, 1.0)])
def test_variance_leaks_at_an_edge_within_another_shadow(device, high, low):
    """Two sheets; all of the floor is dark, but where the filter sees both, light leaks (Lauritzen 2007, 8.4.3).

    A share q of depths −`high` and the rest at −`low`, the floor at 0: σ² = q(1−q)Δ², µ = −(q·high + (1−q)·low). The
    filter goes through all q; the largest leak over q is what the largest on the floor must be.
    """
    x, seen = under_sheets(device, "variance_shadow_map", (high, 0.0), (low, 1.0), bleeding=0.0, blur=1)
    depths = np.array([-high, -low])
    leak = np.array([chebyshev(depths, np.array([q, 1 - q]), 0.0) for q in SHARES])
    assert seen.max() == pytest.approx(leak.max(), abs=0.01)
    assert leak.max() > 0.005
    reduced = under_sheets(device, "variance_shadow_map", (high, 0.0), (low, 1.0), bleeding=0.1, blur=1)[1]
    assert np.abs(reduced - np.maximum((seen - 0.1) / 0.9, 0)).max() < 1e-5
    # A texel is 6 m over the map's inner part; three texels and the hardware's filter reach 2 of them from the edge.
    texel = 6 / (RESOLUTION - 6)
    assert seen[np.abs(x) > 2.5 * texel].max() < 1e-3


def test_variance_leaks_more_the_nearer_the_lower_sheet(device):
    """As published: it depends on the ratio of Δ to what separates the receiver from the lower one."""
    pairs = [((2.0, 0.0), (low, 1.0)) for low in (0.2, 0.5, 1.0)]
    leaks = [under_sheets(device, "variance_shadow_map", *pair, bleeding=0.0)[1].max() for pair in pairs]
    assert leaks[0] > leaks[1] > leaks[2] > 0.02
    assert leaks[0] > 0.5


@pytest.mark.parametrize("technique", ["variance_shadow_map", "moment_shadow_map"])
def test_one_sheet_does_not_leak(device, technique):
    """With one depth the variance is 0 away from its edge, whatever the height."""
    for height in (0.1, 1.0):
        _, seen = under_sheets(device, technique, (height, 1.0), bleeding=0.0)
        assert seen.max() < 1e-3


@pytest.mark.parametrize("exponent", [20.0, 80.0])
def test_an_exponential_leaks_under_what_is_near(device, exponent):
    """A sheet at height h over the floor lets e^(−c·h/D) through, D the scene's depth (Annen et al. 2008, eq. 6).

    A second sheet higher up does not let more through, unlike with the moments: the nearest blocker counts for nearly
    everything. D is 2 m.
    """
    for low in (0.1, 0.3):
        _, one = under_sheets(device, "exponential_shadow_map", (low, 1.0), (2.0, -2.5), exponent=exponent)
        leak = np.exp(-exponent * low / 2.0)
        assert one.min() == pytest.approx(one.max(), rel=1e-3)
        assert np.log(one.mean()) == pytest.approx(np.log(leak), abs=1e-4 * exponent)
        _, both = under_sheets(device, "exponential_shadow_map", (low, 1.0), (2.0, 0.0), exponent=exponent)
        assert both.max() <= one.max() * (1 + 1e-3)


def test_moments_do_not_leak_under_two_sheets_but_under_three(device):
    """Four moments hold two depths exactly, with their shares (Peters & Klein 2015); of three they prove less.

    Under three sheets whose edges lie within the filter, all of the floor is dark. The leak is what the moments do not
    prove, for some of the shares that the filter can have; the bound itself is held to linear programming below.
    """
    for technique in ("variance_shadow_map", "moment_shadow_map"):
        two = under_sheets(device, technique, (2.0, 0.0), (0.5, 1.0), bleeding=0.0)[1].max()
        assert (two > 0.1) == (technique == "variance_shadow_map")
        assert technique == "variance_shadow_map" or two < 0.01
    texel = 6 / (RESOLUTION - 6)
    _, seen = under_sheets(device, "moment_shadow_map", (2.0, -texel), (1.1, texel), (0.3, 1.0), bleeding=0.0)
    shares = np.array([(a, 1 - a - b, b) for a in SHARES[25:-25:25] for b in (1 - a) * SHARES[25:-25:25]])
    moments = shares @ np.array([-2.0, -1.1, -0.3])[:, None] ** np.arange(1, 5)
    leaks = 1 - least_before(moments.T, np.zeros(len(shares)))
    assert 0.03 < seen.max() <= leaks.max() + 0.01


def least_by_programming(depths: np.ndarray, weights: np.ndarray, depth: float) -> float:
    """The least share before a depth of all distributions with these depths' four moments, on a grid out to ±40.

    Hamburger's problem knows no ends of the depths: the extremal distribution may have a little weight far outside.
    """
    far = np.geomspace(2.5, 40, 120)
    grid = np.sort(np.concatenate([-far, np.linspace(-2.5, 2.5, 401), far, depths, [depth]]))
    columns = (grid[:, None] ** np.arange(5)).T
    scale = np.maximum(grid**4, 1.0)
    found = linprog(
        (grid < depth - 1e-9) / scale, A_eq=columns / scale, b_eq=weights @ (depths[:, None] ** np.arange(5))
    )
    assert found.status == 0, found.message
    return float(found.fun)


@pytest.mark.parametrize("seed", range(4))
def test_the_bound_of_four_moments_is_the_sharpest(seed):
    """The twin, with which the shader is held, against linear programming over a grid of depths."""
    rng = np.random.default_rng(seed)
    for _ in range(5):
        depths, weights = rng.uniform(-2, 2, 5), rng.dirichlet(np.ones(5))
        moments = weights @ depths[:, None] ** np.arange(1, 5)
        z = rng.uniform(-2, 2)
        ours = least_before(moments[:, None], np.array([z]))[0]
        assert least_by_programming(depths, weights, z) == pytest.approx(ours, abs=0.005)
        assert ours <= weights[depths < z].sum() + 1e-9


@pytest.mark.parametrize("technique", FILTERED)
@pytest.mark.parametrize("light", [NOON, LIGHTS["point"], LIGHTS["spot"]], ids=lambda light: light.name)
def test_a_scene_without_depth_is_lit(device, technique, light):
    """Two sheets in one plane: as the sun sees them at noon all depths are one."""
    sheets = [Shape(f"sheet {x}", shapes.plane(2, 4), WHITE, moved(x, 0.7, 0.0)) for x in (-1.0, 1.0)]
    scene = scene_of(*sheets, view=ABOVE, lights=(light,))
    points, seen = visibility_of(device, technique, scene, resolution=RESOLUTION)
    lit = points.hit
    if isinstance(light, SpotLight):
        direction, _ = towards(light, points.position.astype(np.float64))
        lit &= -direction @ np.array(light.direction) > np.cos(light.outer)
    assert lit.sum() > 500
    assert seen[lit].min() > 0.97


@pytest.mark.parametrize("technique", FILTERED)
def test_holes_are_holes_in_maps_that_are_filtered(device, technique):
    """A sheet half of which is cut out, at noon, well off the cut."""
    texture = Texture(image([[[255, 255, 255, 255], [255, 255, 255, 0]]]), min_filter="nearest", mag_filter="nearest")
    cut = Material("cut", base_color_texture=texture, alpha_mode="mask", double_sided=True)
    scene = scene_of(FLOOR, leaf(cut), view=camera((0, 0.4, 0), (0, 0, 0), ymag=0.45, near=0.01), lights=(NOON,))
    points, seen = visibility_of(device, technique, scene, resolution=RESOLUTION)
    x = points.position[..., 0]
    assert seen[x < -0.1].max() < 0.01 and seen[x > 0.1].min() > 0.99
