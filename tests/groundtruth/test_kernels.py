"""A kernel is compiled once: another seed, batch or scene of the same kind compiles nothing."""

from collections.abc import Callable

import numpy as np
import pytest

from lightmeter.groundtruth.oracles import direct, environment_visibility, indirect, visibility
from lightmeter.groundtruth.primary import surface_points
from lightmeter.groundtruth.reference import render_batch
from lightmeter.groundtruth.scattering import MULTISCATTER, SINGLE
from lightmeter.groundtruth.variant import dr
from lightmeter.groundtruth.world import World
from lightmeter.scenes import shapes
from lightmeter.scenes.model import Environment, Material, PointLight, Scene, Shape

from .small_scenes import looking


def grid(color: float, count: int = 12) -> Scene:
    """Spheres of as many materials, all of one kind."""
    balls = []
    for i in range(count):
        matrix = np.eye(4)
        matrix[0, 3] = i - count / 2
        material = Material(base_color=(color, 0.5, 0.3), metallic=i / count, roughness=0.2 + 0.7 * i / count)
        balls.append(Shape(f"ball {i}", shapes.sphere(0.4, 12), material, matrix))
    return Scene(
        "grid",
        tuple(balls),
        looking((0, 1, 8), (0, 0, 0), yfov=0.6),
        lights=(PointLight("lamp", (1, 3, 2), (color, 9, 9)),),
        environment=Environment((color, 0.2, 0.1)),
    )


def compiled(work: Callable[[], object]) -> tuple[int, int]:
    """How many kernels were launched, and how many of them had to be compiled or fetched from the disk."""
    with dr.scoped_set_flag(dr.JitFlag.KernelHistory):
        dr.kernel_history()
        work()
        kernels = [k for k in dr.kernel_history() if k["type"] == dr.KernelType.JIT]
    return len(kernels), sum(not k["cache_hit"] for k in kernels)


def everything(world: World, seed: int) -> None:
    points = surface_points(world, (20, 10), np.random.default_rng(seed).random(2))
    direct.evaluate(world, points, 0)
    visibility.evaluate(world, points, 0, spp=4, seed=seed)
    environment_visibility.evaluate(world, points, spp=4, seed=seed)
    indirect.evaluate(world, points, spp=4, seed=seed)


def test_another_seed_compiles_nothing():
    world = World.of(grid(0.5))
    render_batch(world, (20, 10), 4, 0)
    assert compiled(lambda: render_batch(world, (20, 10), 4, 1)) == (1, 0)
    assert compiled(lambda: render_batch(world, (24, 12), 7, 2, 3)) == (1, 0)


def test_another_batch_of_the_oracles_compiles_nothing():
    world = World.of(grid(0.5))
    everything(world, 0)
    for seed in (1, 2, 3):
        launched, new = compiled(lambda seed=seed: everything(world, seed))
        assert launched > 0
        assert new == 0


def test_another_scene_of_the_same_kind_compiles_nothing_and_materials_share_one_bsdf():
    first = World.of(grid(0.5))
    assert len({id(mesh.bsdf()) for mesh in first.meshes}) == 1
    render_batch(first, (20, 10), 4, 0)
    del first
    other = World.of(grid(0.7))
    assert compiled(lambda: render_batch(other, (20, 10), 4, 0)) == (1, 0)


@pytest.mark.parametrize("scattering", [SINGLE, MULTISCATTER])
def test_other_points_compile_nothing(scattering):
    """However many they are, and wherever NumPy has put them: at the address of a whole vector, or beside it."""
    world = World.of(grid(0.5), scattering)

    def new(width: int) -> int:
        points = surface_points(world, (width, 10), np.full(2, 0.5))
        return compiled(lambda: direct.evaluate(world, points, 0, spp=2))[1]

    new(20)
    assert [new(width) for width in range(21, 29)] == [0] * 8
