"""The BSDF that the reference scatters with: sampling against density, reciprocity, energy, published albedos."""

import numpy as np
import pytest
from scipy import stats

from lightmeter.groundtruth.variant import dr, mi
from lightmeter.groundtruth.world import World
from lightmeter.scenes.model import Material, Scene, Shape
from lightmeter.scenes.optics import material as optics

from .. import white_metal
from .aligned import aligned
from .noise import assert_mean, sidak
from .small_scenes import floor, looking

CASES = [
    (metallic, roughness, degrees)
    for metallic, roughness in [(0, 0.1), (0, 0.45), (0, 1), (1, 0.05), (1, 0.3), (1, 1), (0.5, 0.6)]
    for degrees in (5, 50, 80)
]


def world_of(material: Material) -> World:
    camera = looking((0, 3, 0), (0, 0, 0), yfov=1, up=(0, 0, -1))
    return World.of(Scene("floor", (Shape("floor", floor(), material),), camera))


def vector(direction):
    """In Dr.Jit, and no literal: one kernel serves all directions."""
    found = mi.Vector3f(*map(float, direction))
    dr.make_opaque(found)
    return found


def seen_from(world: World, direction, count: int):
    """Intersections at the floor's middle, seen from a direction; the BSDF there."""
    towards = vector(direction)
    ray = mi.Ray3f(mi.Point3f(0.1, 0, 0.05) + 2 * towards + dr.zeros(mi.Point3f, count), -towards)
    si = world.mitsuba.ray_intersect(ray)
    assert bool(dr.all(si.is_valid()))
    return si, world.meshes[0].bsdf()


def tilted(degrees: float, turn: float = 0.7) -> np.ndarray:
    polar = np.radians(degrees)
    return np.array([np.sin(polar) * np.cos(turn), np.cos(polar), np.sin(polar) * np.sin(turn)])


@pytest.mark.parametrize(("metallic", "roughness", "degrees"), CASES)
def test_samples_follow_the_density(metallic, roughness, degrees):
    """chi², at a level that leaves all cases together one false alarm in 10⁴.

    Cells lie in the half vector's azimuth and, logarithmically, in tan θ/α: so they resolve both a narrow lobe and the
    wide one beside it. What `sample` throws away (below the horizon) is one cell more.
    """
    count, rings, sectors = 400_000, 48, 12
    world = world_of(Material(base_color=(0.8, 0.5, 0.2), metallic=metallic, roughness=roughness))
    alpha, view = max(roughness**2, 1e-3), tilted(degrees)
    rng = np.random.default_rng([13, int(10 * metallic), int(100 * roughness), degrees])
    u = aligned(rng.random((3, count)))
    si, bsdf = seen_from(world, view, count)
    drawn, _ = bsdf.sample(mi.BSDFContext(), si, mi.Float(u[0]), mi.Point2f(u[1], u[2]))
    kept = drawn.pdf.numpy() > 0
    half = si.to_world(drawn.wo).numpy()[:, kept].astype(float) + view[:, None]
    slope = np.hypot(half[0], half[2]) / (half[1] * alpha)
    ring = np.minimum((np.log1p(slope) / reach(alpha) * rings).astype(int), rings - 1)
    sector = ((np.arctan2(half[2], half[0]) / (2 * np.pi) % 1) * sectors).astype(int) % sectors
    seen = np.bincount(ring * sectors + sector, minlength=rings * sectors)
    expected = count * cell_probabilities(world, view, alpha, rings, sectors)
    seen = np.append(seen, count - seen.sum())
    expected = np.append(expected, max(count - expected.sum(), 0))
    assert expected.sum() <= count * 1.002
    many = expected >= 20
    chi2 = np.sum((seen[many] - expected[many]) ** 2 / expected[many])
    chi2 += (seen[~many].sum() - expected[~many].sum()) ** 2 / max(expected[~many].sum(), 1)
    p = stats.chi2.sf(chi2, many.sum())
    assert many.sum() > 50
    assert p > sidak(len(CASES)), f"p = {p:.2g}, chi² = {chi2:.1f} for {many.sum()} cells"


def reach(alpha: float) -> float:
    """The logarithm of 1 + tan θ/α where the cells end, at 89.99°."""
    return float(np.log1p(np.tan(np.radians(89.99)) / alpha))


def cell_probabilities(world, view, alpha, rings, sectors, steps=24) -> np.ndarray:
    """The density's integral over each cell, by the midpoint rule."""
    t = (np.arange(rings * steps) + 0.5) / (rings * steps)
    phi = (np.arange(sectors * steps) + 0.5) / (sectors * steps) * 2 * np.pi
    t, phi = (grid.ravel() for grid in np.meshgrid(t, phi, indexing="ij"))
    slope = np.expm1(t * reach(alpha))
    cosine = 1 / np.sqrt(1 + (alpha * slope) ** 2)
    sine = alpha * slope * cosine
    half = np.stack([sine * np.cos(phi), cosine, sine * np.sin(phi)])
    v_dot_h = view @ half
    light = 2 * v_dot_h * half - view[:, None]
    si, bsdf = seen_from(world, view, len(t))
    wo = si.to_local(mi.Vector3f(*aligned(light)))
    density = bsdf.pdf(mi.BSDFContext(), si, wo).numpy().astype(float)
    # dl = 4 v·h dh; dh = sin θ dθ dφ; dθ = cos²θ·α ds for s = tan θ/α; ds = (1 + s)·reach·dt.
    per_t = sine * cosine**2 * alpha * (1 + slope) * reach(alpha)
    weight = np.where(v_dot_h > 0, density * 4 * v_dot_h * per_t, 0) / (rings * steps) * 2 * np.pi / (sectors * steps)
    return weight.reshape(rings, steps, sectors, steps).sum(axis=(1, 3)).ravel()


@pytest.mark.parametrize(("metallic", "roughness"), [(0, 0.2), (0, 1), (1, 0.3), (0.5, 0.7)])
def test_sampling_weights_are_value_over_density_and_values_are_the_optics(metallic, roughness):
    """Against the same formulas in float64; the tolerance is float32's for α ≥ 0.04, see the module of the GGX."""
    material = Material(base_color=(0.8, 0.5, 0.2), metallic=metallic, roughness=roughness)
    world = world_of(material)
    rng = np.random.default_rng(3)
    u = aligned(rng.random((3, 4096)))
    view = tilted(40)
    si, bsdf = seen_from(world, view, 4096)
    drawn, weight = bsdf.sample(mi.BSDFContext(), si, mi.Float(u[0]), mi.Point2f(u[1], u[2]))
    value, density = bsdf.eval_pdf(mi.BSDFContext(), si, drawn.wo)
    light = si.to_world(drawn.wo).numpy().astype(float)
    up = np.zeros((3, 4096))
    up[1] = 1
    point = optics.MaterialPoint(
        np.repeat(np.array(material.base_color)[:, None], 4096, 1),
        np.full(4096, metallic, float),
        np.full(4096, roughness, float),
        np.ones(4096),
    )
    exact = optics.evaluate(point, up, np.repeat(view[:, None], 4096, 1), light)
    np.testing.assert_allclose(value.numpy(), exact, rtol=2e-4, atol=1e-6)
    kept = drawn.pdf.numpy() > 0
    ratio = value.numpy()[:, kept] / density.numpy()[kept]
    np.testing.assert_allclose(weight.numpy()[:, kept], ratio, rtol=1e-4)
    joint = bsdf.eval_pdf_sample(mi.BSDFContext(), si, drawn.wo, mi.Float(u[0]), mi.Point2f(u[1], u[2]))
    np.testing.assert_allclose(joint[0].numpy(), value.numpy(), rtol=1e-6)
    np.testing.assert_allclose(joint[3].numpy(), weight.numpy(), rtol=1e-6)


def test_it_is_reciprocal():
    world = world_of(Material(base_color=(0.9, 0.4, 0.1), metallic=0.4, roughness=0.35))
    context = mi.BSDFContext()
    rng = np.random.default_rng(5)
    for _ in range(8):
        a, b = tilted(rng.uniform(0, 85), rng.uniform(0, 6.28)), tilted(rng.uniform(0, 85), rng.uniform(0, 6.28))
        si, bsdf = seen_from(world, a, 1)
        there = bsdf.eval(context, si, si.to_local(vector(b))).numpy().ravel() / b[1]
        si, bsdf = seen_from(world, b, 1)
        back = bsdf.eval(context, si, si.to_local(vector(a))).numpy().ravel() / a[1]
        np.testing.assert_allclose(there, back, rtol=1e-4)


@pytest.mark.parametrize(("alpha", "mu", "albedo"), white_metal.ALBEDOS)
def test_the_white_metals_albedo_is_the_published_one(alpha, mu, albedo):
    """Single scattering GGX, F = 1, height-correlated Smith (design, section 8); four digits are published."""
    world = world_of(Material(metallic=1, roughness=float(np.sqrt(alpha))))
    rng = np.random.default_rng(7)
    batches = []
    for _ in range(8):
        u = aligned(rng.random((3, 200_000)))
        si, bsdf = seen_from(world, tilted(np.degrees(np.arccos(mu))), u.shape[1])
        _, weight = bsdf.sample(mi.BSDFContext(), si, mi.Float(u[0]), mi.Point2f(u[1], u[2]))
        batches.append(weight.numpy()[0].mean())
    assert_mean(np.array(batches), albedo, slack=5e-5, half_width=1e-3)


@pytest.mark.parametrize("roughness", [0.0, 0.2, 0.6, 1.0])
@pytest.mark.parametrize("other", [{"metallic": 1.0}, {"specular": 0.0}])
def test_white_metals_and_white_lambert_make_no_light(roughness, other):
    """The albedo is at most 1 under all angles, with one false alarm in 10⁴ over all cases.

    Of white dielectrics with specular 1 this is not true: glTF weighs the diffuse base by 1 − F(v·h), which at
    grazing angles leaves more than the gloss takes.
    """
    world = world_of(Material(roughness=roughness, **other))
    rng = np.random.default_rng(11)
    quantile = stats.norm.ppf(1 - sidak(8 * 6))
    for degrees in (0, 30, 60, 75, 85, 89):
        u = aligned(rng.random((3, 100_000)))
        si, bsdf = seen_from(world, tilted(degrees), u.shape[1])
        _, weight = bsdf.sample(mi.BSDFContext(), si, mi.Float(u[0]), mi.Point2f(u[1], u[2]))
        weights = weight.numpy()[0].astype(float)
        assert np.all(np.isfinite(weights))
        assert weights.mean() <= 1 + 1e-5 + quantile * weights.std() / np.sqrt(len(weights))


@pytest.mark.parametrize("double_sided", [False, True])
def test_the_back_is_black_unless_double_sided(double_sided):
    world = world_of(Material(base_color=(0.5, 0.5, 0.5), specular=0, double_sided=double_sided))
    below = -tilted(30)
    si, bsdf = seen_from(world, below, 1)
    same_side = si.to_local(mi.Vector3f(*map(float, -tilted(50))))
    other_side = si.to_local(mi.Vector3f(*map(float, tilted(50))))
    expected = 0.5 / np.pi * np.cos(np.radians(50)) if double_sided else 0
    context = mi.BSDFContext()
    np.testing.assert_allclose(bsdf.eval(context, si, same_side).numpy().ravel(), expected, rtol=1e-5)
    assert np.all(bsdf.eval(context, si, other_side).numpy() == 0)
    drawn, _ = bsdf.sample(context, si, mi.Float([0.9]), mi.Point2f([0.3], [0.4]))
    assert (drawn.pdf.numpy()[0] > 0) == double_sided
