"""Scene files: what they mean, and what is said when they are wrong."""

import json

import numpy as np
import pytest

from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.framing import CAMERA_NOTE, LIGHTS_NOTE
from lightmeter.scenes.load import load
from lightmeter.scenes.model import DirectionalLight, PointLight, SpotLight
from lightmeter.scenes.toml import schema

from .synthetic_gltf import png, quad

BALL = '[[shapes]]\ntype = "sphere"\nsegments = 8\n'


def read(tmp_path, text):
    path = tmp_path / "scene.toml"
    path.write_text(text)
    return load(path)


def refused(tmp_path, text) -> str:
    with pytest.raises(SceneError) as caught:
        read(tmp_path, text)
    message = str(caught.value)
    assert message.startswith(str(tmp_path / "scene.toml")) and "\n" not in message
    return message.removeprefix(f"{tmp_path / 'scene.toml'}: ")


def test_the_least_scene_gets_a_camera_and_lights_and_says_so(tmp_path):
    scene = read(tmp_path, BALL)
    assert scene.name == "scene" and len(scene.shapes) == 1
    assert scene.notes == (CAMERA_NOTE, LIGHTS_NOTE)
    assert len(scene.lights) == 2 and scene.environment is not None


@pytest.mark.parametrize(
    "light", ["[environment]\nradiance = 0\n", "lights = []\n", "[materials.default]\nemissive = 1\n"]
)
def test_the_rig_stays_away_where_the_file_speaks_of_light(tmp_path, light):
    scene = read(tmp_path, light + BALL)
    assert LIGHTS_NOTE not in scene.notes and scene.lights == ()


def test_every_kind_of_light(tmp_path):
    scene = read(
        tmp_path,
        """
        [[lights]]
        type = "point"
        position = [1, 2, 3]
        intensity = 4
        color = [1, 0.5, 0]
        range = 2.5
        [[lights]]
        type = "spot"
        name = "s"
        position = [0, 2, 0]
        target = [0, 0, 0]
        intensity = [1, 2, 3]
        inner = 10
        outer = 30
        [[lights]]
        type = "directional"
        direction = [0, 0, -2]
        irradiance = 3
        """
        + BALL,
    )
    point, spot, sun = scene.lights
    assert point == PointLight("point 0", (1, 2, 3), (4, 2, 0), 2.5)
    assert isinstance(spot, SpotLight) and spot.direction == (0, -1, 0) and spot.intensity == (1, 2, 3)
    assert (spot.inner, spot.outer) == pytest.approx(np.radians((10, 30))) and spot.range is None
    assert sun == DirectionalLight("directional 2", (0, 0, -1), (3, 3, 3))


def test_camera_by_target_and_by_matrix(tmp_path):
    scene = read(tmp_path, "[camera]\nposition = [0, 0, 5]\ntarget = [0, 0, 0]\nyfov = 60\nexposure = 1.5\n" + BALL)
    np.testing.assert_allclose(scene.camera.matrix[:3, :3], np.eye(3), atol=1e-12)
    assert scene.camera.yfov == pytest.approx(np.pi / 3) and scene.camera.exposure == 1.5
    assert 3.9 < scene.camera.near < 4 and 6 < scene.camera.far < 6.1
    rows = "[[1,0,0,1],[0,1,0,2],[0,0,1,3],[0,0,0,1]]"
    scene = read(tmp_path, f"[camera]\nmatrix = {rows}\nymag = 2\nnear = 0.5\n" + BALL)
    np.testing.assert_allclose(scene.camera.position, [1, 2, 3])
    assert (scene.camera.ymag, scene.camera.near) == (2, 0.5)


@pytest.mark.parametrize(
    ("place", "moved"),
    [
        ("translate = [1, 2, 3]", [2, 2, 3]),
        ("rotate = [0, 0, 90]", [0, 1, 0]),
        ("rotate = [90, 0, 90]", [0, 1, 0]),
        ("rotate = [0, 90, 90]", [0, 0, -1]),
        ("axis = [0, 0, 5]\nangle = 90", [0, 1, 0]),
        ("scale = 2\ntranslate = [0, 1, 0]", [2, 1, 0]),
        ("scale = [3, 1, 1]\nrotate = [0, -90, 0]", [0, 0, 3]),
        ("scale = [-1, 1, 1]", [-1, 0, 0]),
        ("matrix = [[0, 0, 0.5, 7], [0, 1, 0, 0], [2, 0, 0, 0], [0, 0, 0, 1]]", [7, 0, 2]),
    ],
)
def test_places(tmp_path, place, moved):
    matrix = read(tmp_path, BALL + place).shapes[0].matrix
    np.testing.assert_allclose((matrix @ [1, 0, 0, 1])[:3], moved, atol=1e-12)


@pytest.mark.parametrize("place", ["scale = [-1, 1, 1]", "scale = [1, -2, 3]\nrotate = [10, 20, 30]", "scale = -1"])
def test_a_mirrored_shape_still_faces_outwards(tmp_path, place):
    world = read(tmp_path, BALL + place).shapes[0].world
    a, b, c = (world.positions[world.triangles[:, i]].astype(np.float64) for i in range(3))
    faces = np.cross(b - a, c - a)
    assert np.sum(a * np.cross(b, c)) > 0  # the volume
    assert np.einsum("mi,mki->mk", faces, world.normals[world.triangles]).min() > 0


def test_materials_and_textures(tmp_path):
    (tmp_path / "textures").mkdir()
    (tmp_path / "textures" / "a.png").write_bytes(png(np.uint8([[[1, 2, 3], [4, 5, 6]]])))
    scene = read(
        tmp_path,
        """
        [materials.tile]
        base_color = [0.1, 0.2, 0.3]
        metallic = 0.5
        specular = 0
        emissive = 2
        alpha_mode = "mask"
        base_color_texture = "textures/a.png"
        [materials.tile.normal_texture]
        file = "textures/a.png"
        wrap = "clamp"
        wrap_v = "mirror"
        min_filter = "nearest"
        offset = [0.5, 0]
        rotation = 90
        scale = [2, 3]
        [materials.lacquer]
        clearcoat = 0.5
        clearcoat_roughness_texture = "textures/a.png"
        """
        + BALL
        + 'material = "tile"',
    )
    shape = scene.shapes[0]
    base, normal = shape.material.base_color_texture, shape.material.normal_texture
    assert shape.material.base_color == (0.1, 0.2, 0.3) and shape.material.emissive == (2, 2, 2)
    assert base.srgb and not normal.srgb and base.image is normal.image
    assert (normal.wrap_u, normal.wrap_v, normal.min_filter) == ("clamp", "mirror", "nearest")
    assert normal.rotation == pytest.approx(np.pi / 2) and normal.scale == (2, 3)
    assert shape.mesh.tangents is not None


def test_meshes_and_whole_gltf_files(tmp_path):
    writer = quad(name="q", translation=[0, 1, 0])
    writer.content["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "directional", "intensity": 5}]}}
    writer.content["cameras"] = [{"type": "perspective", "name": "inside", "perspective": {"yfov": 1, "znear": 1}}]
    writer.node(extensions={"KHR_lights_punctual": {"light": 0}})
    writer.node(camera=0, translation=[0, 0, 5])
    writer.save(tmp_path, "q.glb")
    (tmp_path / "t.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    text = """
        materials.red.base_color = [1, 0, 0]
        [[shapes]]
        type = "gltf"
        file = "q.glb"
        translate = [10, 0, 0]
        rotate = [0, 90, 0]
        [[shapes]]
        type = "mesh"
        file = "q.glb"
        material = "red"
        [[shapes]]
        type = "mesh"
        file = "t.obj"
        name = "triangle"
        """
    scene = read(tmp_path, text)
    whole, alone, triangle = scene.shapes
    assert (whole.name, alone.name, triangle.name) == ("gltf 0/q", "mesh 1/q", "triangle")
    np.testing.assert_allclose(whole.matrix @ [1, 0, 0, 1], [10, 1, -1, 1], atol=1e-12)
    np.testing.assert_allclose(alone.matrix @ [1, 0, 0, 1], [1, 1, 0, 1])
    assert alone.material.base_color == (1, 0, 0) and whole.material.metallic == 1
    assert triangle.mesh.normals is None
    (light,) = scene.lights
    np.testing.assert_allclose(light.direction, (-1, 0, 0), atol=1e-12)
    assert scene.camera.name == "inside"
    np.testing.assert_allclose(scene.camera.position, [15, 0, 0], atol=1e-12)
    assert read(tmp_path, text.replace('"q.glb"', '"q.glb"\nlights = false', 1)).lights != scene.lights


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[camra]\n" + BALL, ["unknown key 'camra'", "Did you mean 'camera'?"]),
        (BALL + "radus = 2", ["shapes[0]", "'radus'", "'radius'"]),
        ("[[shapes]]\ntype = 'shpere'", ["shapes[0].type", "'sphere'"]),
        ("[[shapes]]\nradius = 1", ["shapes[0]", "'type' is missing"]),
        ("[[shapes]]\ntype = 'mesh'", ["shapes[0].file", "required"]),
        ("[materials.red]\n" + BALL + "material = 'rde'", ["shapes[0].material", "'rde'", "'red'"]),
        (BALL + "material = 'red'", ["there is no material 'red'", "[materials.NAME]"]),
        (BALL + "radius = -1", ["shapes[0].radius", "got -1"]),
        (BALL + "radius = '1'", ["shapes[0].radius", "number", "got '1'"]),
        (BALL + "radius = true", ["shapes[0].radius", "got True"]),
        (BALL + "radius = nan", ["shapes[0].radius", "finite", "got nan"]),
        (BALL + "radius = inf", ["shapes[0].radius", "got inf"]),
        (BALL.replace("8", "8.0"), ["shapes[0].segments", "whole number"]),
        (BALL.replace("8", "9999999999"), ["shapes[0].segments", "at most 1024"]),
        (BALL + "scale = 0", ["shapes[0]", "scale of 0"]),
        (BALL + "scale = [1, 2]", ["shapes[0].scale[2]", "too short"]),
        (BALL + "rotate = [1, 2, 3]\nangle = 3", ["shapes[0]", "not both"]),
        (BALL + "axis = [0, 0, 0]\nangle = 3", ["shapes[0].axis", "no length"]),
        (BALL + "matrix = [[1,0,0,0],[1,0,0,0],[0,0,1,0],[0,0,0,1]]", ["shapes[0]", "determinant"]),
        (BALL + "matrix = [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,2]]", ["shapes[0]", "last row"]),
        ("[materials.a]\nroughness = 1.5\n" + BALL, ["materials.a.roughness", "at most 1, got 1.5"]),
        ("[materials.a]\nalpha_mode = 'blend'\n" + BALL, ["materials.a.alpha_mode", "opaque, mask", "'blend'"]),
        ("[materials.a]\nbase_color = [1, 2, 1]\n" + BALL, ["materials.a.base_color[1]"]),
        ("max_depth = 0\n" + BALL, ["max_depth"]),
        ("max_depth = true\n" + BALL, ["max_depth"]),
        ("[camera]\nyfov = 40\n" + BALL, ["camera", "position and target"]),
        ("[camera]\nposition = [0,0,1]\ntarget = [0,0,0]\n" + BALL, ["camera", "yfov"]),
        ("[camera]\nposition = [0,0,1]\ntarget = [0,0,1]\nyfov = 40\n" + BALL, ["camera", "target is where"]),
        ("[camera]\nposition = [0,0,1]\ntarget = [0,0,0]\nyfov = 180\n" + BALL, ["camera.yfov", "at most 179"]),
        ("[environment]\n" + BALL, ["environment", "a radiance, a map or both"]),
        ("[environment]\nradiance = -1\n" + BALL, ["environment.radiance"]),
        ("[[lights]]\ntype = 'sun'\n" + BALL, ["lights[0].type", "point, spot, directional"]),
        (
            "[[lights]]\ntype='spot'\nposition=[0,1,0]\ntarget=[0,0,0]\nintensity=1\ninner=30\nouter=20\n" + BALL,
            ["lights[0]", "inner (30°) must be below outer (20°)"],
        ),
        ("[[shapes]]\ntype = 'torus'\nminor = 2", ["shapes[0]", "meets itself"]),
        ("[[shapes]]\ntype = 'mesh'\nfile = '../a.obj'", ["shapes[0].file", "leads out"]),
        ("[[shapes]]\ntype = 'mesh'\nfile = 'http://example.org/a.obj'", ["shapes[0].file", "nothing is fetched"]),
        ("[[shapes]]\ntype = 'mesh'\nfile = 'a.stl'", ["shapes[0].file", ".obj, .ply"]),
        ("[[shapes]]\ntype = 'gltf'\nfile = 'none.glb'", ["shapes[0].file", "no such file"]),
        ("[materials.a]\nbase_color_texture = 'none.png'\n" + BALL, ["materials.a.base_color_texture", "no such file"]),
        ("", ["no triangles"]),
        ("a = ", ["no TOML"]),
        ("a = " + "[" * 20_000, ["nested too deeply"]),
        ("a = " + "9" * 5000, ["no TOML"]),
    ],
)  # fmt: skip
def test_what_is_wrong_is_named(tmp_path, text, words):
    message = refused(tmp_path, text)
    for word in words:
        assert word in message


def test_several_faults_are_counted(tmp_path):
    message = refused(tmp_path, BALL + "radius = -1\nname = 7\n[environment]\nradiance = 'x'")
    assert "2 more faults in this file" in message


def test_a_fault_in_a_file_that_is_named_says_both_places(tmp_path):
    (tmp_path / "bad.obj").write_text("v 0 0 0\nf 1 2 3\n")
    message = refused(tmp_path, "[[shapes]]\ntype = 'mesh'\nfile = 'bad.obj'")
    assert message.startswith("shapes[0].file: ") and "bad.obj: line 2" in message


def test_too_many_shapes_are_refused_before_they_fill_the_memory(tmp_path):
    big = '[[shapes]]\ntype = "torus"\nsegments = 1024\nrings = 1024\n'
    from lightmeter.scenes import checks

    limit, checks.MOST_VERTICES = checks.MOST_VERTICES, 1_500_000
    try:
        assert "too large" in refused(tmp_path, big * 40)
    finally:
        checks.MOST_VERTICES = limit


def test_bytes_that_are_no_text(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_bytes(b"\xff\xfe")
    with pytest.raises(SceneError, match="no TOML"):
        load(path)


def test_an_unknown_scene_names_the_nearest(tmp_path):
    with pytest.raises(SceneError, match="cornell-box"):
        load("cornel-box")
    with pytest.raises(SceneError, match="no such file"):
        load(tmp_path / "none.toml")


def test_the_json_schema_is_plain_json_with_every_key_described():
    text = json.dumps(schema())
    assert json.loads(text)["$schema"].startswith("https://json-schema.org/")
    definitions = schema()["$defs"]
    assert definitions["SphereEntry"]["additionalProperties"] is False
    assert definitions["CameraEntry"]["properties"]["yfov"]["description"]
    assert definitions["MaterialEntry"]["properties"]["roughness"]["maximum"] == 1
