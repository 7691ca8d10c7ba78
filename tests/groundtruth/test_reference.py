"""The reference: which way is up, the same image as Mitsuba's own parts give, repeatable batches."""

import math

import numpy as np
import pytest

from lightmeter.groundtruth import primary
from lightmeter.groundtruth.oracles import direct
from lightmeter.groundtruth.reference import render_batch
from lightmeter.groundtruth.variant import mi
from lightmeter.groundtruth.world import World
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Environment, Material, PointLight, Scene, Shape, SpotLight

from .noise import assert_mean, assert_same_mean, blocks
from .small_scenes import floor, looking, points_at, rectangle


def glowing(name: str, color, mesh) -> Shape:
    return Shape(name, mesh, Material(base_color=(0, 0, 0), specular=0, emissive=color))


@pytest.mark.parametrize("lens", [{"yfov": math.radians(60)}, {"ymag": 2.0}])
def test_row_0_is_the_top_and_column_0_the_left(lens):
    """A camera turned to +X: its right is +Z, a red mark up, a green one right, a blue one at the bottom left."""
    marks = (
        glowing("up", (1, 0, 0), rectangle((4, 1.2, 0.4), (0, 0, -0.8), (0, 0.6, 0))),
        glowing("right", (0, 1, 0), rectangle((4, -0.4, 2), (0, 0, -0.6), (0, 0.8, 0))),
        glowing("corner", (0, 0, 1), rectangle((4, -1.9, -1.3), (0, 0, -0.6), (0, 0.6, 0))),
    )
    # Fronts must face the camera at −X.
    marks = tuple(Shape(m.name, facing(m.mesh, (-1, 0, 0)), m.material) for m in marks)
    camera = looking((0, 0, 0), (1, 0, 0), **lens)
    image = render_batch(World.of(Scene("marks", marks, camera)), (40, 40), 4, 0)
    rows, columns = np.arange(40) + 0.5, np.arange(40) + 0.5
    centres = {}
    for c, name in enumerate(("up", "right", "corner")):
        weight = image[..., c]
        assert weight.sum() > 4, name
        centres[name] = ((weight.sum(1) @ rows) / weight.sum(), (weight.sum(0) @ columns) / weight.sum())
    scale = 20 / (2.0 if "ymag" in lens else 4 * math.tan(math.radians(30)))
    for name, (height, right) in {"up": (1.5, 0), "right": (0, 1.7), "corner": (-1.6, -1.6)}.items():
        expected = (20 - scale * height, 20 + scale * right)
        np.testing.assert_allclose(centres[name], expected, atol=0.35, err_msg=name)


def facing(mesh, direction):
    """The mesh with its front towards `direction`."""
    p = mesh.positions[mesh.triangles[0]]
    if np.dot(np.cross(p[1] - p[0], p[2] - p[0]), direction) > 0:
        return mesh
    return type(mesh)(mesh.positions, mesh.triangles[:, ::-1], None, mesh.texcoords)


def test_wide_images_keep_the_vertical_angle():
    square = glowing("square", (1, 1, 1), rectangle((-1, -1, -4), (2, 0, 0), (0, 2, 0)))
    camera = looking((0, 0, 0), (0, 0, -1), yfov=2 * math.atan(0.5))
    for size in ((64, 32), (32, 64)):
        image = render_batch(World.of(Scene("square", (square,), camera)), size, 16, 0)[..., 0]
        # Half of the height at distance 4 is 2 m, so the square is half as high as the image, and as wide.
        np.testing.assert_allclose(image.sum(), (size[1] / 2) ** 2, rtol=0.02)


def mitsubas_own(scene: Scene, size, spp: int, count: int, folder) -> np.ndarray:
    """The same scene from Mitsuba's own `diffuse`, `perspective` and film, by `mi.render`."""
    parts = {"type": "scene", "integrator": {"type": "path", "rr_depth": 5}}
    for i, shape in enumerate(scene.shapes):
        mesh = mi.Mesh(shape.name, len(shape.world.positions), len(shape.world.triangles))
        parameters = mi.traverse(mesh)
        parameters["vertex_positions"] = mi.Float(shape.world.positions.ravel())
        parameters["faces"] = mi.UInt32(shape.world.triangles.ravel())
        parameters.update()
        mesh.write_ply(str(folder / f"{i}.ply"))
        parts[f"shape{i}"] = {
            "type": "ply",
            "filename": str(folder / f"{i}.ply"),
            "face_normals": True,
            "bsdf": {"type": "diffuse", "reflectance": {"type": "rgb", "value": list(shape.material.base_color)}},
        }
        if shape.material.emits:
            radiance = {"type": "rgb", "value": list(shape.material.emissive)}
            parts[f"shape{i}"]["emitter"] = {"type": "area", "radiance": radiance}
    camera = scene.camera
    parts["sensor"] = {
        "type": "perspective",
        "fov": math.degrees(camera.yfov),
        "fov_axis": "y",
        # Mitsuba's cameras look along +Z with +X to the left.
        "to_world": mi.ScalarTransform4f(camera.matrix @ np.diag([-1.0, 1, -1, 1])),
        "film": {
            "type": "hdrfilm",
            "width": size[0],
            "height": size[1],
            "rfilter": {"type": "box"},
            "pixel_format": "rgb",
            "component_format": "float32",
        },
    }
    loaded = mi.load_dict(parts)
    return np.stack([np.array(mi.render(loaded, spp=spp, seed=1000 + b)) for b in range(count)])


def test_it_agrees_with_mitsubas_own_diffuse_and_path_on_the_cornell_box(tmp_path):
    """Over 8 × 8 pixel blocks, so that batch means are near normal; Welch's t with Šidák's correction."""
    scene, size = load("cornell-box"), (64, 64)
    world = World.of(scene)
    ours = np.stack([render_batch(world, size, 32, 3, b) for b in range(16)])
    theirs = mitsubas_own(scene, size, 32, 16, tmp_path)
    assert ours.mean() == pytest.approx(theirs.mean(), rel=0.01)
    assert_same_mean(blocks(ours, 8), blocks(theirs, 8))
    assert_same_mean(ours.mean(axis=(1, 2)), theirs.mean(axis=(1, 2)))


def test_batches_repeat_to_the_bit_and_differ_from_each_other():
    world = World.of(load("torus"))
    first = render_batch(world, (32, 24), 4, 5, 0)
    assert first.shape == (24, 32, 3)
    assert first.dtype == np.float32
    np.testing.assert_array_equal(first, render_batch(World.of(load("torus")), (32, 24), 4, 5, 0))
    other = [render_batch(world, (32, 24), 4, 5, 1), render_batch(world, (32, 24), 4, 6, 0)]
    for image in other:
        assert np.mean(image == first) < 0.3
    noise = [image - first for image in other]
    assert np.abs(np.mean(noise)) < 0.05


def test_many_wavefronts_give_what_one_gives(monkeypatch):
    """An image that does not fit into one wavefront: by rows and by samples."""
    from lightmeter.groundtruth import wavefront

    world = World.of(load("torus"))
    whole = np.stack([render_batch(world, (32, 24), 8, 5, b).mean(axis=(0, 1)) for b in range(8)])
    monkeypatch.setattr(wavefront, "MAX_LANES", 500)
    parts = np.stack([render_batch(world, (32, 24), 8, 5, b).mean(axis=(0, 1)) for b in range(8)])
    assert_same_mean(whole, parts)


def test_the_spot_falls_off_as_gltf_says():
    """0.09 of the full intensity at 35° in a cone of 20° and 40° (Mitsuba's own spot has 0.25)."""
    light = SpotLight("spot", (0, 2, 0), (0, -1, 0), (1, 1, 1), math.radians(20), math.radians(40))
    white = Material(base_color=(1, 1, 1), specular=0)
    x = 2 * math.tan(math.radians(35))
    camera = looking((x, 4, 0), (x, 0, 0), ymag=0.002, up=(0, 0, -1))
    world = World.of(Scene("spot", (Shape("floor", floor(4), white),), camera, lights=(light,), max_depth=2))
    cosine = math.cos(math.radians(35))
    share = ((cosine - math.cos(light.outer)) / (math.cos(light.inner) - math.cos(light.outer))) ** 2
    assert share == pytest.approx(0.0935, abs=5e-5)
    expected = share * cosine**3 / 4 / math.pi
    image = render_batch(world, (4, 4), 64, 0)
    np.testing.assert_allclose(image.mean(axis=(0, 1)), expected, rtol=2e-4)
    oracle = direct.evaluate(world, points_at([(x, 0, 0)], (0, 1, 0), (0, 1, 0)), 0)
    np.testing.assert_allclose(oracle[0, 0], expected, rtol=1e-5)


@pytest.mark.parametrize("cone", [None, (1.2, 1.5)], ids=["point", "spot"])
def test_a_range_ends_the_light_in_reference_and_oracle_alike(cone):
    """Half of the way: 15/16 of what falls off with the squared distance; beyond the range nothing."""
    given = ("light", (0, 2, 0)), ((4.0, 2.0, 1.0),)
    white = Material(base_color=(1, 1, 1), specular=0)
    camera = looking((0, 4, 0), (0, 0, 0), ymag=0.002, up=(0, 0, -1))
    for reach, share in ((4.0, 15 / 16), (1.9, 0.0), (None, 1.0)):
        if cone:
            light = SpotLight(*given[0], (0, -1, 0), *given[1], *cone, range=reach)
        else:
            light = PointLight(*given[0], *given[1], range=reach)
        world = World.of(Scene("range", (Shape("floor", floor(4), white),), camera, lights=(light,), max_depth=2))
        expected = share * np.array((4.0, 2.0, 1.0)) / 4 / math.pi
        image = render_batch(world, (4, 4), 16, 0)
        np.testing.assert_allclose(image.mean(axis=(0, 1)), expected, rtol=2e-4)
        oracle = direct.evaluate(world, points_at([(0, 0, 0)], (0, 1, 0), (0, 1, 0)), 0)
        np.testing.assert_allclose(oracle[0, 0], expected, rtol=1e-5)


def test_nothing_to_see_and_nothing_that_shines():
    camera = looking((0, 1, 3), (0, 0, 0), yfov=0.8)
    empty = World.of(Scene("empty", (), camera, environment=Environment((0.5, 1, 2))))
    np.testing.assert_allclose(render_batch(empty, (4, 4), 2, 0), np.broadcast_to([0.5, 1, 2], (4, 4, 3)))
    points = primary.surface_points(empty, (4, 4))
    assert not points.hit.any()
    np.testing.assert_allclose(points.emission, np.broadcast_to([0.5, 1, 2], (4, 4, 3)))
    dark = World.of(Scene("dark", (Shape("floor", floor(), Material()),), camera))
    assert not render_batch(dark, (4, 4), 2, 0).any()
    nothing = World.of(Scene("nothing", (), camera))
    assert not render_batch(nothing, (4, 4), 2, 0).any()


def test_what_is_seen_at_one_place_and_over_the_pixel_is_the_same_on_average():
    world = World.of(load("cornell-box"))
    rng = np.random.default_rng(0)
    there = np.stack([primary.seen_emission(world, (24, 24), o).mean(axis=(0, 1)) for o in rng.random((200, 2))])
    everywhere = primary.seen_emission(world, (24, 24), spp=1024).mean(axis=(0, 1))
    assert_mean(there, everywhere)
