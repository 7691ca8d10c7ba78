"""The truth with many bounces on the microsurface: against the walk in float64, energy, reciprocity, independence."""

import math

import numpy as np
import pytest
from scipy import stats

from lightmeter.groundtruth import microsurface
from lightmeter.groundtruth.oracles import environment_visibility, indirect, visibility
from lightmeter.groundtruth.primary import surface_points
from lightmeter.groundtruth.reference import render_batch
from lightmeter.groundtruth.scattering import MULTISCATTER
from lightmeter.groundtruth.variant import dr, mi
from lightmeter.groundtruth.world import World
from lightmeter.scenes import shapes
from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Environment, Material, PointLight, Scene, Shape
from lightmeter.scenes.optics import material as optics
from lightmeter.scenes.optics import microfacet
from lightmeter.scenes.optics.microsurface import walk

from .. import white_metal
from .aligned import aligned
from .noise import assert_mean, assert_same_mean, sidak
from .small_scenes import floor, looking, placed

COUNT = 20_000
BATCHES = 8
BASE = (0.9, 0.5, 0.2)
UP = mi.Vector3f(0, 0, 1)


def material(roughness: float, metallic: float = 1.0, base=BASE) -> optics.MaterialPoint:
    """Opaque numbers: one kernel serves all materials."""
    parameters = mi.Color3f(*base), mi.Float(metallic), mi.Float(roughness), mi.Float(1)
    dr.make_opaque(*parameters)
    return optics.MaterialPoint(*parameters)


def leaning(cosine: float) -> np.ndarray:
    return np.array([math.sqrt(1 - cosine**2), 0, cosine])


def vector(direction):
    """(3,) or (3, N), as arrays that no kernel has as constants."""
    found = mi.Vector3f(*(mi.Float(aligned(x)) for x in direction))
    dr.make_opaque(found)
    return found


def draws(seed: int) -> tuple[mi.Point2f, microsurface.Noise]:
    """Uniform pairs, and noise that differs from lane to lane."""
    rng = np.random.default_rng(seed)
    u = aligned(rng.random((4, COUNT)))
    return mi.Point2f(u[0], u[1]), microsurface.Noise(mi.Float(u[2]), mi.Float(u[3]))


def cosine_directions(seed: int) -> np.ndarray:
    """(3, N), by the cosine."""
    rng = np.random.default_rng(seed)
    cosine, turn = np.sqrt(1 - rng.random(COUNT)), 2 * np.pi * rng.random(COUNT)
    return np.stack([np.sqrt(1 - cosine**2) * np.cos(turn), np.sqrt(1 - cosine**2) * np.sin(turn), cosine])


def in_cells(direction: np.ndarray, values: np.ndarray) -> np.ndarray:
    """(C, 24) mean of values (C, N) that fall into cells of the hemisphere, 4 rings by 6 sectors of equal cosine."""
    ring = np.minimum((direction[2] ** 2 * 4).astype(int), 3)
    sector = ((np.arctan2(direction[1], direction[0]) / (2 * np.pi) % 1) * 6).astype(int) % 6
    cell = ring * 6 + sector
    return np.stack([np.bincount(cell, row, minlength=24) for row in values]) / direction.shape[1]


@pytest.mark.parametrize(("alpha", "metallic", "cosine"), [(0.25, 1.0, 0.3), (0.8, 0.4, 0.7), (0.1, 1.0, 0.2)])
def test_further_bounces_are_those_of_the_walk_in_double_precision(alpha, metallic, cosine):
    """What leaves into each cell by two bounces or more: the estimate over directions against the walks' histogram.

    The walk in NumPy follows dielectric and metal as channels of its own, and shares no loop with the other.
    """
    view = leaning(cosine)

    def reflectance(c):
        metal = microfacet.f_schlick(c, np.array(BASE)[:, None], 1.0)
        return np.concatenate([microfacet.f_schlick(c, optics.DIELECTRIC_F0, 1.0)[None], metal])

    ours, theirs = [], []
    for batch in range(BATCHES):
        rng = np.random.default_rng([batch, 77])
        found = walk(np.repeat(view[:, None], COUNT, 1), alpha, reflectance, rng)
        weight = np.where(found.bounces >= 2, (1 - metallic) * found.weight[:1] + metallic * found.weight[1:], 0)
        theirs.append(in_cells(found.direction, weight))
        light = cosine_directions(1000 + batch)
        _, noise = draws(batch)
        value = microsurface.towards(material(math.sqrt(alpha), metallic), UP, vector(view), vector(light), noise)
        ours.append(in_cells(light, value.numpy().astype(float) / (light[2] / np.pi)))
    assert np.mean(ours) > 1e-3 / 24
    assert_same_mean(np.array(ours), np.array(theirs))


@pytest.mark.parametrize("metallic", [1.0, 0.5])
def test_sampling_and_evaluation_are_of_one_lobe(metallic):
    """E[weight·g] of samples is E[f·cos·g/p] of directions by the cosine, for g a cell's indicator; base included."""
    view, point = vector(leaning(0.5)), material(0.8, metallic)
    drawn, evaluated = [], []
    for batch in range(BATCHES):
        u, noise = draws(batch)
        chosen = mi.Float(aligned(np.random.default_rng(500 + batch).random(COUNT)))
        direction, weight, _ = microsurface.sample(point, UP, view, (chosen, u.x, u.y), noise)
        drawn.append(in_cells(direction.numpy().astype(float), weight.numpy().astype(float)))
        light = cosine_directions(2000 + batch)
        value, _ = microsurface.evaluate(point, UP, view, vector(light), draws(3000 + batch)[1])
        evaluated.append(in_cells(light, value.numpy().astype(float) / (light[2] / np.pi)))
    assert_same_mean(np.array(drawn), np.array(evaluated))


@pytest.mark.parametrize("alpha", [1.0, 0.25])
def test_a_white_metal_returns_all_light(alpha):
    """Every walk weighs 1, and the integral of f·cos is 1."""
    point, view = material(math.sqrt(alpha), base=(1, 1, 1)), vector(leaning(0.6))
    integrals = []
    for batch in range(BATCHES):
        u, noise = draws(batch)
        _, weight, density = microsurface.sample(point, UP, view, (mi.Float(0.5), u.x, u.y), noise)
        np.testing.assert_allclose(weight.numpy()[0], 1, rtol=1e-5)
        assert (density.numpy() > 0).all()
        light = cosine_directions(batch)
        value, _ = microsurface.evaluate(point, UP, view, vector(light), noise)
        integrals.append(np.mean(value.numpy()[0] / (light[2] / np.pi)))
    assert_mean(np.array(integrals), 1, half_width=0.04)


@pytest.mark.parametrize(("alpha", "loss"), white_metal.LOSSES)
def test_further_bounces_bring_what_single_scattering_loses(alpha, loss):
    """The mean energy losses of the design, section 8, to its three digits."""
    point, found = material(math.sqrt(alpha), base=(1, 1, 1)), []
    for batch in range(BATCHES):
        view, light = cosine_directions(10 + batch), cosine_directions(50 + batch)
        value = microsurface.towards(point, UP, vector(view), vector(light), draws(batch)[1])
        found.append(np.mean(value.numpy()[0] / (light[2] / np.pi)))
    assert_mean(np.array(found), loss, slack=5e-4, half_width=0.03)


def test_it_is_reciprocal():
    """f(v, l) = f(l, v) of the bounces beyond the first, within noise, at angles that differ much."""
    point = material(0.8)
    a, b = leaning(0.25), np.array([0.3, -0.4, math.sqrt(0.75)])

    def lobe(view, light, seed):
        values = [
            microsurface.towards(point, UP, vector(view), vector(light), draws(seed + i)[1]).numpy().mean(axis=1)
            for i in range(BATCHES)
        ]
        return np.array(values) / light[2]

    assert_same_mean(lobe(a, b, 0), lobe(b, a, 100))


def test_estimates_of_different_samples_are_independent():
    """Noise from neighbours: places, directions or times that differ by one bit in the last digit.

    Of N independent pairs a correlation has the standard error 1/√N.
    """
    above = looking((0, 3, 0), (0, 0, 0), up=(0, 0, -1), yfov=1)
    world = World.of(Scene("floor", (Shape("floor", floor(), Material(metallic=1.0)),), above), "multiscatter")
    start = np.full(COUNT, 0.1, np.float32).view(np.uint32)
    x = (start + np.arange(COUNT, dtype=np.uint32)).view(np.float32)
    si = world.mitsuba.ray_intersect(mi.Ray3f(mi.Point3f(x, 2, 0.05), mi.Vector3f(0, -1, 0)))
    si.p = mi.Point3f(x, 0, 0.05)
    bsdf, wo = world.meshes[0].bsdf(), mi.Vector3f(0.6, 0, 0.8)

    def noise(si, wo):
        values = bsdf.eval(mi.BSDFContext(), si, wo).numpy()[0]
        return (values - values.mean()) / values.std()

    first = noise(si, wo)
    np.testing.assert_array_equal(noise(si, wo), first)
    si.time = mi.Float(float(np.nextafter(np.float32(0), np.float32(1))))
    later = noise(si, wo)
    turned = noise(si, mi.Vector3f(float(np.nextafter(np.float32(0.6), np.float32(1))), 0, 0.8))
    pairs = [(first[1:], first[:-1]), (first, later), (later, turned), (first[64:], first[:-64])]
    sure = stats.norm.isf(sidak(len(pairs)) / 2) / math.sqrt(COUNT - 64)
    for a, b in pairs:
        assert abs(np.mean(a * b)) < sure


def test_the_oracles_compose_to_the_reference():
    """A rough metal ball on a rough floor, in a point light, a lamp and a grey environment: no bias beyond noise.

    Each batch of the oracles has sub-pixel offsets of its own, so that its noise holds that of the silhouettes.
    """
    glow = Material(base_color=(0, 0, 0), specular=0, emissive=(6, 6, 6), double_sided=True)
    scene = Scene(
        "rough",
        (
            Shape("ball", shapes.sphere(0.7, 24), Material(base_color=BASE, metallic=1.0, roughness=0.9)),
            Shape("floor", floor(8, -0.7), Material(base_color=(0.8, 0.8, 0.8), metallic=0.7, roughness=1.0)),
            Shape("lamp", floor(0.4), glow, placed(-2, 2, 1)),
        ),
        looking((0, 3, 3), (0, -0.3, 0), yfov=0.6),
        lights=(PointLight("point", (1.5, 2, 2), (12, 12, 12)),),
        environment=Environment((0.3, 0.3, 0.3)),
    )
    world, size = World.of(scene, "multiscatter"), (16, 16)
    rng = np.random.default_rng(1)
    ours = []
    for batch in range(BATCHES):
        frames = []
        for frame, offset in enumerate(rng.random((2, 2))):
            points, how = surface_points(world, size, offset), {"spp": 64, "seed": frame, "batch": batch}
            image = sum(visibility.evaluate(world, points, light, **how)[0] for light in (0, 1))
            image += environment_visibility.evaluate(world, points, **how)[0]
            frames.append(image + indirect.evaluate(world, points, **how))
        ours.append(np.mean(frames, axis=(0, 1, 2, 3)))
    truth = np.stack([render_batch(world, size, 256, 1, batch) for batch in range(BATCHES)])
    ours, truth = np.array(ours), truth.mean(axis=(1, 2, 3), dtype=float)
    assert_same_mean(ours, truth)
    assert (ours.std(ddof=1) + truth.std(ddof=1)) / math.sqrt(BATCHES) < 8e-3 * truth.mean()


def test_layers_are_refused():
    """The walk knows nothing of a coat: a wrong number would be the alternative."""
    with pytest.raises(SceneError, match=r"shape 'coat.*'multiscatter' is not defined"):
        World.of(load("material-layers"), MULTISCATTER)
