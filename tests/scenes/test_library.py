"""The built-in scenes: they load, isolate what they say, and follow the schema."""

import re
import subprocess
import sys
import tomllib

import numpy as np
import pytest

from lightmeter.scenes import library
from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.load import load
from lightmeter.scenes.toml import schema

NAMES = (
    "area-lights",
    "atrium",
    "avenue",
    "control",
    "cornell-box",
    "corner",
    "gem",
    "glass-ball",
    "grid-sun",
    "lamps",
    "lattice",
    "layers",
    "material-layers",
    "metal-rough-grid",
    "mirrors",
    "penumbra",
    "plane",
    "posts",
    "tessellation",
    "torus",
    "window",
)


def test_names_and_summaries():
    assert tuple(library.names()) == NAMES
    for name in NAMES:
        assert re.fullmatch(r"[^\n]{20,120}\.", library.summary(name))
    with pytest.raises(SceneError, match="torus"):
        library.path("torsu")


@pytest.mark.parametrize("name", NAMES)
def test_every_scene_is_complete_and_inside_the_clipping_distances(name):
    scene = load(name)
    assert scene.name == name and scene.summary == library.summary(name) and scene.notes == ()
    assert (scene.all_lights or scene.environment) and scene.max_depth == -1
    forward = -scene.camera.matrix[:3, 2]
    for shape in scene.shapes:
        depth = (shape.world.positions - scene.camera.position) @ forward
        assert depth.max() <= scene.camera.far
        assert depth.min() >= scene.camera.near or depth.min() < 1  # a floor may pass under the camera


def test_the_control_scene_needs_direct_light_alone():
    """Every point that is seen is lit, on the true triangles: none of it is in its own shadow."""
    scene = load("control")
    (shape,), (light,) = scene.shapes, scene.lights
    assert shape.material.specular == 0 and scene.environment is None and not scene.area_lights
    mesh = shape.world
    a, b, c = (mesh.positions[mesh.triangles[:, i]].astype(np.float64) for i in range(3))
    faces = np.cross(b - a, c - a)
    seen = np.sum(faces * (scene.camera.position - a), axis=1) > 0
    lit = np.sum(faces * (np.array(light.position) - a), axis=1) > 0
    assert seen.sum() > 1000 and lit[seen].all()
    for corner in range(3):  # and the shading normals agree with that
        normals = mesh.normals[mesh.triangles[:, corner]]
        positions = mesh.positions[mesh.triangles[:, corner]]
        assert np.sum(normals * (np.array(light.position) - positions), axis=1)[seen].min() > 0


@pytest.mark.parametrize("name", ["plane", "control"])
def test_the_simple_scenes_are_diffuse_under_one_light(name):
    scene = load(name)
    assert len(scene.shapes) == len(scene.all_lights) == 1 and scene.environment is None
    assert scene.shapes[0].material.specular == 0 and not scene.shapes[0].material.textures


def test_the_plane_fills_the_picture():
    scene = load("plane")
    edge = np.tan(scene.camera.yfov / 2)
    for x in (-edge, edge):
        for y in (-edge, edge):
            ray = scene.camera.matrix[:3, :3] @ [x, y, -1]
            point = scene.camera.position - ray * scene.camera.position[1] / ray[1]
            assert ray[1] < 0 and np.abs(point[[0, 2]]).max() < 10


def test_the_cornell_box_is_closed_but_for_the_front_and_lit_from_above():
    scene = load("cornell-box")
    (light,) = scene.all_lights
    shape = scene.shapes[light.shape]
    low, high = scene.bounds
    np.testing.assert_allclose(high - low, (0.5528, 0.5488, 0.5592), atol=1e-6)
    np.testing.assert_allclose(shape.world.normals, [[0, -1, 0]] * 4, atol=1e-6)
    assert 0 < high[1] - shape.world.positions[0, 1] < 0.005
    assert scene.camera.position[2] > high[2]
    middle = np.array([0, 0.2744, -0.2796])
    for name in ("floor", "ceiling", "back wall", "left wall", "right wall"):
        wall = next(s for s in scene.shapes if s.name == name).world
        assert np.sum(wall.normals[0] * (middle - wall.positions[0])) > 0  # faces inwards
    for name in ("short box", "tall box"):
        block = next(s for s in scene.shapes if s.name == name).world.positions
        assert block[:, 1].min() == pytest.approx(0, abs=1e-6)
        assert (block.min(axis=0) > low - 1e-6).all() and (block.max(axis=0) < high).all()


def test_the_grid_spans_the_material_and_every_sphere_is_seen_from_the_front():
    scene = load("metal-rough-grid")
    values = {(s.material.metallic, round(s.material.roughness, 2)) for s in scene.shapes}
    assert len(values) == 36
    assert {m for m, _ in values} >= {0, 1} and max(r for _, r in values) == 1
    assert {type(light).__name__ for light in scene.lights} == {"PointLight", "SpotLight", "DirectionalLight"}
    edge = np.tan(scene.camera.yfov / 2)
    for shape in scene.shapes:
        local = (shape.world.positions - scene.camera.position) @ scene.camera.matrix[:3, :3]
        assert np.abs(local[:, :2] / -local[:, 2:]).max() < edge
        middle = shape.matrix[:3, 3] - scene.camera.position
        assert middle @ -scene.camera.matrix[:3, 2] / np.linalg.norm(middle) > np.cos(np.radians(8))


@pytest.mark.parametrize("name", [n for n in NAMES if library.path(n).suffix == ".toml"])
def test_the_json_schema_accepts_the_library(name):
    jsonschema = pytest.importorskip("jsonschema", reason="jsonschema is not installed")
    jsonschema.validate(tomllib.loads(library.path(name).read_text(encoding="utf-8")), schema())


def test_the_json_schema_refuses_a_misspelt_key():
    jsonschema = pytest.importorskip("jsonschema", reason="jsonschema is not installed")
    content = tomllib.loads(library.path("torus").read_text(encoding="utf-8"))
    content["shapes"][0]["widht"] = 1
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(content, schema())


def test_the_model_and_the_names_import_neither_pydantic_nor_pil():
    code = (
        "import sys, lightmeter.scenes.model, lightmeter.scenes.load, lightmeter.scenes.library as l; l.names();"
        "print([m for m in ('pydantic', 'PIL', 'scipy', 'mitsuba', 'moderngl') if m in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
