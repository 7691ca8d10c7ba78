"""What `lightmeter export` writes: read back it is the same scene; and what it says where it cannot write."""

import json
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lightmeter.exporting import Exported, export
from lightmeter.scenes import library, shapes
from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.export import camera_document
from lightmeter.scenes.export.radiant import color_and_strength
from lightmeter.scenes.framing import gives_light, look_at
from lightmeter.scenes.image_files.reading import read_image
from lightmeter.scenes.load import load
from lightmeter.scenes.model import (
    Camera,
    DirectionalLight,
    Environment,
    Image,
    Material,
    Mesh,
    PointLight,
    Scene,
    Shape,
    SpotLight,
    Texture,
)
from lightmeter.scenes.tangents import with_tangents

from ..scenes.test_sample_files import SAMPLES, sample

SIZE = (48, 32)
ULP = 2.0**-23
ODD = 'a "b" \\ / ../c\n\t\0 Ω 光 💡 \udcff'
NEAREST = {"min_filter": "nearest", "mag_filter": "nearest"}


def placed(*diagonal: float, x: float = 0.0, shear: float = 0.0) -> np.ndarray:
    """Scaled, sheared, turned a little, and moved."""
    matrix = np.diag([*diagonal, 1.0])
    matrix[0, 1] = shear
    matrix = look_at((0.0, 0.0, 0.0), (0.1, -0.2, -1.0)) @ matrix
    matrix[0, 3] = x
    return matrix


def everything() -> Scene:
    """A scene with all that the model has, the unusual ones among it."""
    rng = np.random.default_rng(1)

    def image(name: str, channels: int, size=(3, 5)) -> Image:
        return Image(rng.integers(0, 256, (*size, channels), np.uint8), name)

    grey = Image(np.repeat(rng.integers(0, 65536, (4, 4, 1)), 3, axis=2).astype(np.float32) / np.float32(65535), "grey")
    rgba, rgb = image("../../up.png", 4), image("C:\\wood.jpg?x", 3)
    painted = Material(
        ODD,
        (0.1, 0.2, 1 / 3),
        alpha=0.75,
        metallic=0.3,
        roughness=0.7,
        specular=0.25,
        emissive=(1 / 3, 40.7, 0.0),
        base_color_texture=Texture(rgba, True, "clamp", "mirror", texcoord=1, offset=(0.1, -2), rotation=0.3),
        metallic_roughness_texture=Texture(rgb, scale=(2.0, 3.0), **NEAREST),
        normal_texture=Texture(rgb, min_filter="nearest_mipmap_linear"),
        normal_scale=0.5,
        occlusion_texture=Texture(grey, min_filter="linear_mipmap_nearest"),
        occlusion_strength=0.4,
        emissive_texture=Texture(image("光", 1), True),
        alpha_mode="mask",
        alpha_cutoff=0.3,
        double_sided=True,
        clearcoat=0.9,
        clearcoat_roughness=1 / 7,
        clearcoat_texture=Texture(rgb, offset=(0.5, 0.25)),
        clearcoat_roughness_texture=Texture(grey, rotation=0.1),
        clearcoat_normal_texture=Texture(rgb, wrap_u="mirror"),
        clearcoat_normal_scale=0.3,
        anisotropy=1 / 3,
        anisotropy_rotation=0.7,
        anisotropy_texture=Texture(rgb, wrap_v="clamp"),
        sheen_color=(0.2, 1 / 3, 0.0),
        sheen_roughness=0.6,
        sheen_color_texture=Texture(rgb, True),
        sheen_roughness_texture=Texture(rgba),
    )
    bump = with_tangents(shapes.sphere(0.5, segments=8))
    bump = replace(bump, texcoords=(*bump.texcoords, bump.texcoords[0] * 2))
    flat = Mesh(np.eye(3), [[0, 1, 2]], colors=rng.random((3, 4)))
    two = Material("grey and alpha", base_color_texture=Texture(image("two", 2), True), emissive=(0.5, 0.25, 1.0))
    made = (
        Shape(ODD, bump, painted, placed(1, 2, 3)),
        Shape("the same mesh", bump, painted, placed(1, 1, 1, x=2)),
        Shape("the same mesh otherwise", bump, Material("plain"), placed(1, 1, 1, x=4)),
        Shape("nothing", Mesh(np.zeros((0, 3)), np.zeros((0, 3))), Material()),
        Shape("flat", flat, Material("coloured")),
        Shape("mirrored", bump, painted, placed(-1, 1, 2, x=6)),
        Shape("sheared", bump, painted, placed(1, 1, 1, x=8, shear=0.5)),
        Shape("sheared and mirrored", flat, Material("coloured"), placed(1, -1, 1, x=10, shear=0.5)),
        Shape("emissive", shapes.rectangle(1, 1), two, placed(1, 1, 1, x=-2)),
    )
    lights = (
        PointLight(ODD, (1 / 3, 2, 3), (1000 / 3, 0.1, 0.0)),
        SpotLight("spot", (0, 5, 0), (0.6, -0.8, 0.0), (4.0, 5.0, 6.0), 0.0, np.pi / 2, 7.5),
        DirectionalLight("sun", (0, -1, 0), (0.3, 0.2, 0.1)),
        PointLight("dark", (0, 0, 0), (0.0, 0.0, 0.0)),
    )
    view = Camera("ortho", look_at((1, 2, 9), (0, 0, 0)), ymag=2.5, near=0.5, far=30.0, exposure=-1.5)
    return Scene(ODD, made, view, lights, Environment((0.1, 0.25, 7.0)))


def spread(texels: np.ndarray) -> np.ndarray:
    """Grey in all three colours, as the loader has it."""
    return texels if texels.shape[2] >= 3 else np.dstack([*[texels[..., 0]] * 3, texels[..., 1:]])


def facts(part: Any) -> dict[str, Any]:
    """A material's or texture's values; texels as bytes, so that they can be compared."""
    out = {field.name: getattr(part, field.name) for field in fields(part)}
    for name, value in out.items():
        if isinstance(value, Texture):
            out[name] = facts(value)
        elif isinstance(value, Image):
            texels = spread(value.texels)
            out[name] = value.name, texels.dtype, texels.shape, texels.tobytes()
    return out


def assert_same(scene: Scene, read: Scene, exact_normals: bool = True) -> None:
    """All that glTF can hold is the same, the triangles in world space to the last bit.

    Unit vectors in float64 are normalised again when they are read, which moves them by two roundings; float32
    normals that were written in world space, by two of theirs.
    """
    solid = [shape for shape in scene.shapes if len(shape.mesh.triangles)]
    for ours, theirs in zip(solid, read.shapes, strict=True):
        assert theirs.name == ours.name.replace("\udcff", "?")
        a, b = ours.world, theirs.world
        assert np.array_equal(a.positions, b.positions) and np.array_equal(a.triangles, b.triangles)
        slack = 0 if exact_normals or "sheared" not in ours.name else 2 * ULP
        for name in ("normals", "tangents", "colors"):
            one, two = getattr(a, name), getattr(b, name)
            assert (one is None) == (two is None), name
            assert one is None or np.abs(one - two).max() <= (0 if name == "colors" else slack), (ours.name, name)
        assert len(a.texcoords) == len(b.texcoords)
        assert all(np.array_equal(*pair) for pair in zip(a.texcoords, b.texcoords, strict=True))
        theirs = facts(theirs.material)
        assert theirs == facts(ours.material) | {"name": ours.material.name.replace("\udcff", "?")}
    slack = 4 * np.finfo(np.float64).eps
    if scene.lights or gives_light(scene.shapes):  # else the loader adds lights
        for ours, theirs in zip(scene.lights, read.lights, strict=True):
            assert type(ours) is type(theirs)
            for field in fields(ours):
                one, two = getattr(ours, field.name), getattr(theirs, field.name)
                if field.name == "direction":
                    assert np.abs(np.subtract(one, two)).max() <= slack
                else:
                    assert two == (one.replace("\udcff", "?") if isinstance(one, str) else one)
    ours, theirs = scene.camera, read.camera
    assert np.abs(ours.matrix - theirs.matrix).max() <= slack * max(1, np.abs(ours.matrix).max())
    for name in ("name", "yfov", "ymag", "near", "far"):
        assert getattr(ours, name) == getattr(theirs, name)


def content(exported: Exported) -> dict[str, Any]:
    """The glTF's JSON; anything but strict JSON fails."""
    return json.loads(exported.gltf.read_text(encoding="utf-8"), parse_constant=pytest.fail)


@pytest.mark.parametrize("name", library.names())
def test_a_library_scene_comes_back_the_same(tmp_path, name):
    scene = load(name)
    exported = export(scene, SIZE, tmp_path / "new" / "folder")
    assert exported.notes == ()
    assert_same(scene, load(exported.gltf))
    assert (exported.environment is None) == (scene.environment is None)


@pytest.mark.parametrize("name", ["FlightHelmet", "TextureTransformTest"])
def test_a_real_scene_comes_back_the_same(tmp_path, name):
    scene = sample(f"{name}/{name}.gltf")
    assert_same(scene, load(export(scene, SIZE, tmp_path).gltf))


def test_everything_comes_back_the_same(tmp_path):
    scene = everything()
    exported = export(scene, SIZE, tmp_path)
    assert_same(scene, load(exported.gltf), exact_normals=False)
    assert ["sheared" in note or "16 bits" in note for note in exported.notes] == [True] * 3
    assert set(exported.files) == {path for path in tmp_path.rglob("*") if path.is_file()}
    assert {path.parent for path in exported.files} == {tmp_path, tmp_path / "textures"}


def test_node_i_is_shape_i_and_what_is_shared_is_written_once(tmp_path):
    scene = everything()
    document = content(export(scene, SIZE, tmp_path))
    names = [node["name"] for node in document["nodes"]]
    assert names[1 : len(scene.shapes)] == [shape.name for shape in scene.shapes[1:]]
    assert "mesh" not in document["nodes"][3]
    assert document["nodes"][0]["mesh"] == document["nodes"][1]["mesh"]
    first, other = (document["meshes"][document["nodes"][i]["mesh"]]["primitives"][0] for i in (1, 2))
    assert first["attributes"] == other["attributes"] and first["material"] != other["material"]
    assert len(document["images"]) == 5 and len(document["materials"]) == 4
    area = next(light for light in camera_document(scene, SIZE)["lights"] if light["kind"] == "area")
    assert area["node"] == 0 and area["index"] == len(scene.lights)


def test_a_flat_mesh_has_no_normals(tmp_path):
    document = content(export(everything(), SIZE, tmp_path))
    flat = document["meshes"][document["nodes"][4]["mesh"]]["primitives"][0]["attributes"]
    assert set(flat) == {"POSITION", "COLOR_0"}


def test_colour_times_strength_loses_no_bit():
    rng = np.random.default_rng(2)
    random = [tuple(row) for row in (10.0 ** rng.uniform(-6, 6, (1000, 3))).tolist()]
    for radiant in [*random, (0.0, 0.0, 0.0), (1.0, 1.0, 0.5), (2.0, 0.0, 4.0), (1 + 2**-52, 1.0, 0.1)]:
        color, strength = color_and_strength(radiant)
        assert tuple(channel * strength for channel in color) == radiant
        assert max(color) <= 1 <= strength


def test_the_environment_is_its_radiance_everywhere(tmp_path):
    exported = export(everything(), SIZE, tmp_path)
    image = read_image(exported.environment)
    assert image.shape == (32, 64, 3) and (image == np.float32((0.1, 0.25, 7.0))).all()


def test_a_scene_without_shapes(tmp_path):
    exported = export(replace(everything(), shapes=(), environment=None), SIZE, tmp_path)
    assert [path.name for path in exported.files] == ["scene.gltf", "camera.json"]
    assert not {"meshes", "buffers", "materials", "accessors"} & set(content(exported))
    with pytest.raises(SceneError, match="no triangles"):
        load(exported.gltf)


def test_floats_that_no_png_holds_are_refused(tmp_path):
    for texels in ([[[0.1, 0.2, 0.3]]], [[[2.0]]], [[[0.123456789]]], [[[0.5, 1.0]]]):
        image = Image(np.array(texels, np.float32), "hdr")
        shape = Shape("s", shapes.rectangle(1, 1), Material("m", normal_texture=Texture(image)))
        with pytest.raises(SceneError, match=r"'hdr' cannot be exported.*uint8"):
            export(Scene("s", (shape,), everything().camera), SIZE, tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_a_texture_that_gltf_would_decode_otherwise_is_refused(tmp_path):
    texture = Texture(Image(np.zeros((1, 1, 3), np.uint8), "t"))
    for slot, given in (("base_color", texture), ("emissive", texture), ("normal", replace(texture, srgb=True))):
        shape = Shape("s", shapes.rectangle(1, 1), Material("m", **{f"{slot}_texture": given}))
        with pytest.raises(SceneError, match=rf"the {slot} texture of material 'm' cannot be exported.*expected"):
            export(Scene("s", (shape,), everything().camera), SIZE, tmp_path)


def test_what_is_not_finite_is_refused_before_anything_is_written(tmp_path):
    scene = load("plane")
    for bad in (
        replace(scene, lights=(PointLight("p", (np.nan, 0, 0), (1, 1, 1)),)),
        replace(scene, shapes=(replace(scene.shapes[0], matrix=np.full((4, 4), np.inf)),)),
        replace(scene, camera=replace(scene.camera, far=np.inf)),
    ):
        with np.errstate(all="ignore"), pytest.raises(SceneError, match=r"plane: .*not finite"):
            export(bad, SIZE, tmp_path)
    assert list(tmp_path.iterdir()) == []


def keys(value: Any) -> set[str]:
    """Every key in a document."""
    if isinstance(value, dict):
        return set(value) | set().union(*map(keys, value.values()))
    return set().union(*map(keys, value)) if isinstance(value, list) else set()


def test_every_key_of_camera_json_is_in_the_docs():
    page = (Path(__file__).parents[2] / "docs" / "candidates.md").read_text(encoding="utf-8")
    perspective = replace(everything(), camera=load("plane").camera)
    for scene in (everything(), perspective, load("cornell-box")):
        for key in keys(camera_document(scene, SIZE)):
            assert f"`{key}`" in page, key


def test_the_command(run, tmp_path):
    found = run("export", "cornell-box", "-o", "out", "--size", "30x20")
    assert found.code == 0 and found.err == ""
    assert "scene.bin, scene.gltf, camera.json" in found.out and "out" in found.out
    camera = json.loads((tmp_path / "out" / "camera.json").read_text())
    assert camera["size"] == [30, 20] and camera["camera"]["aspect"] == 1.5
    assert run("export", "cornell-box", "--json").json["folder"] == "lightmeter-out/cornell-box-export"


def test_a_camera_is_chosen(run, tmp_path):
    scene = sample("Cameras/Cameras.gltf", camera=1)
    assert run("export", SAMPLES / "Cameras/Cameras.gltf", "--camera", 1, "-o", "out").code == 0
    camera = json.loads((tmp_path / "out" / "camera.json").read_text())["camera"]
    assert camera["kind"] == "orthographic" and camera["ymag"] == scene.camera.ymag


def test_a_scene_does_not_overwrite_itself(run, refused, tmp_path):
    """Many glTF files are called scene.gltf, and their buffers scene.bin."""
    assert run("export", "plane", "-o", "out").code == 0
    before = (tmp_path / "out" / "scene.gltf").read_bytes()
    assert "own files" in refused("export", "out/scene.gltf", "-o", tmp_path / "out" / ".." / "out")
    assert (tmp_path / "out" / "scene.gltf").read_bytes() == before
    assert run("export", "out/scene.gltf", "-o", "out/again").code == 0


TEXTURED = """
[camera]
position = [0, 1, 2]
target = [0, 0, 0]
yfov = 40
[materials.m]
base_color_texture = { file = "t.png" }
[[shapes]]
type = "plane"
material = "m"
"""


def test_folders_that_cannot_be_written(refused, tmp_path):
    from PIL import Image as Picture

    Picture.new("RGB", (2, 2)).save(tmp_path / "t.png")
    (tmp_path / "scene.toml").write_text(TEXTURED)
    (tmp_path / "file").touch()
    assert "found a file" in refused("export", "plane", "-o", "file")
    assert "cannot be written to" in refused("export", "plane", "-o", "file/below")
    assert "/proc/none: cannot be written to" in refused("export", "plane", "-o", "/proc/none")
    (tmp_path / "textured").mkdir()
    (tmp_path / "textured" / "textures").touch()
    assert "textured/textures: " in refused("export", "scene.toml", "-o", "textured")
    (tmp_path / "taken" / "scene.gltf").mkdir(parents=True)
    assert "taken/scene.gltf: cannot be written" in refused("export", "plane", "-o", "taken")
    assert [path.name for path in (tmp_path / "taken").iterdir() if path.name.startswith(".")] == []
