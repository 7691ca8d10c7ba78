"""Emissive surfaces that Mitsuba's own area light does not cover: textures, masks, both sides."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.groundtruth.emitters import SurfaceEmitter
from lightmeter.groundtruth.oracles import direct, indirect, visibility
from lightmeter.groundtruth.primary import seen_emission, surface_points
from lightmeter.groundtruth.reference import render_batch
from lightmeter.groundtruth.variant import mi
from lightmeter.groundtruth.world import World
from lightmeter.scenes import shapes
from lightmeter.scenes.model import Image, Material, Scene, Shape, Texture

from .noise import assert_mean, assert_same_mean
from .small_scenes import WHITE, floor, looking, points_at, rectangle

SIZE = (24, 24)
CAMERA = looking((0, 1.5, 4), (0, 0.5, 0), yfov=0.7)


def lamp_world(**emission) -> World:
    """A floor under a card that glows; the card hangs upright with its front towards +Z."""
    card = rectangle((-0.5, 0.2, 0), (1, 0, 0), (0, 1, 0))
    material = Material(**({"base_color": (0.3, 0.3, 0.3), "specular": 0, "emissive": (3, 3, 3)} | emission))
    ground = Material(base_color=(0.6, 0.6, 0.6), specular=0)
    return World.of(Scene("lamp", (Shape("floor", floor(3), ground), Shape("card", card, material)), CAMERA))


def checks(alpha=False) -> Texture:
    texels = np.full((2, 2, 4), 255, np.uint8)
    if alpha:
        texels[0, 0, 3] = texels[1, 1, 3] = 0
    else:
        texels[0, 0] = texels[1, 1] = 20
    return Texture(Image(texels), mag_filter="nearest", wrap_u="clamp", wrap_v="clamp")


@pytest.mark.parametrize(
    "emission",
    [
        {"emissive_texture": checks()},
        {"double_sided": True},
        {"base_color_texture": checks(alpha=True), "alpha_mode": "mask"},
        {"base_color_texture": checks(alpha=True), "alpha_mode": "mask", "double_sided": True},
    ],
    ids=["textured", "double sided", "masked", "masked, double sided"],
)
def test_light_sampling_and_the_oracles_agree_with_a_path_tracer_that_only_finds_lights_by_chance(emission):
    """Mitsuba's own loop without our light sampling: rays that follow the material and look at what they hit."""
    world = lamp_world(**emission)
    assert isinstance(world.meshes[1].emitter(), SurfaceEmitter)
    truth = np.stack([render_batch(world, SIZE, 64, 0, b).mean(axis=(0, 1)) for b in range(8)])
    rng = np.random.default_rng(2)
    composed, by_chance = [], []
    for b in range(8):
        total, found = np.zeros(3), np.zeros(3)
        for j in range(4):
            points = surface_points(world, SIZE, rng.random((*SIZE, 2)))
            light = visibility.evaluate(world, points, 0, spp=8, seed=j, batch=b)[0]
            total += (points.emission + light + indirect.evaluate(world, points, spp=8, seed=j, batch=b)).mean(
                (0, 1)
            ) / 4
            found += light.mean((0, 1)) / 4
        composed.append(total)
        by_chance.append(found)
    assert_same_mean(np.stack(composed), truth)
    blind = np.stack([without_light_sampling(world, 128, b).mean(axis=(0, 1)) for b in range(8)])
    seen = seen_emission(world, SIZE, spp=4096).mean(axis=(0, 1))
    assert_mean(blind - np.stack(by_chance) - seen, 0, slack=2e-3)


def without_light_sampling(world: World, spp: int, batch: int) -> np.ndarray:
    """Direct light with the emission seen, by the material's directions alone (`volpath` cannot be told to)."""
    from lightmeter.groundtruth import rays
    from lightmeter.groundtruth.camera import PrimaryRays
    from lightmeter.groundtruth.wavefront import average

    camera, context = PrimaryRays(world.scene.camera, SIZE), mi.BSDFContext()

    def estimate(lanes):
        ray = camera.through(lanes.place, lanes.pattern.next(), lanes.pattern.next())
        si = rays.first_hit(world, ray, mi.Bool(True))
        seen = si.emitter(world.mitsuba).eval(si, si.is_valid())
        drawn, weight = si.bsdf().sample(context, si, lanes.sampler.next_1d(), lanes.sampler.next_2d(), si.is_valid())
        onwards = si.spawn_ray(si.to_world(drawn.wo))
        hit = rays.first_hit(world, onwards, si.is_valid() & (drawn.pdf > 0))
        return list(seen + weight * hit.emitter(world.mitsuba).eval(hit, hit.is_valid()))

    image = average(SIZE[0] * SIZE[1], spp, (77, batch), estimate, 3, 2)
    return image.T.reshape(*SIZE, 3)


def test_a_double_sided_card_lights_both_sides_and_a_single_sided_one_its_front():
    for double_sided in (False, True):
        world = lamp_world(double_sided=double_sided)
        points = points_at([(0, 0, 1), (0, 0, -1)], (0, 1, 0), (0, 1, 0))
        front, back = direct.evaluate(world, points, 0, spp=2048)[0, :, 0]
        assert front > 0.1
        assert back == (pytest.approx(front, rel=0.02) if double_sided else 0)


def test_a_textured_light_shines_with_its_mean_radiance_from_afar():
    dim, bright = 3 * (20 / 255), 3.0
    world = lamp_world(emissive_texture=checks())
    points = points_at([(0, 0.7, 30)], (0, 0, -1), (0, 0, -1), shape=0)
    batches = np.stack([direct.evaluate(world, points, 0, spp=512, batch=b)[0, 0, 0] for b in range(8)])
    assert_mean(batches, (dim + bright) / 2 / np.pi / 900, slack=1e-3 * bright / np.pi / 900)


def test_a_light_that_shadows_itself_does_so_in_b_too():
    """A glowing bowl (the inside of half a box): `direct` is the light alone in space, so A = B without others."""
    box = shapes.box(1, 1, 1)
    inner = replace(box, triangles=box.triangles[:, ::-1], normals=None)
    lamp = Material(base_color=(0, 0, 0), specular=0, emissive=(1, 1, 1))
    world = World.of(Scene("bowl", (Shape("box", inner, lamp),), CAMERA))
    assert not world.is_flat(world.scene.area_lights[0])
    points = points_at([(0, 0, 0.1)], (0, 1, 0), (0, 1, 0), material=WHITE)
    both = np.stack([visibility.evaluate(world, points, 0, spp=2048, batch=b)[:, 0, 0, 0] for b in range(8)])
    # Every direction meets the box from inside: all of the hemisphere shines with radiance 1.
    assert_mean(both[:, 1], 1.0, half_width=0.01)
