"""Each glTF feature that is read, on files written here."""

import json

import numpy as np
import pytest

from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.framing import CAMERA_NOTE, LIGHTS_NOTE
from lightmeter.scenes.load import load
from lightmeter.scenes.model import DirectionalLight, Material, PointLight, Scene, SpotLight

from .synthetic_gltf import QUAD, QUAD_UV, TWO, UP, Writer, png, quad

CHECKER = png(np.uint8([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 255]]]))


def one(writer: Writer, tmp_path, name: str = "scene.glb") -> Scene:
    return load(writer.save(tmp_path, name))


def material(tmp_path, writer: Writer | None = None, **keys) -> Material:
    writer = writer or Writer()
    writer.node(mesh=writer.mesh(material=keys))
    return one(writer, tmp_path).shapes[0].material


@pytest.mark.parametrize("name", ["scene.glb", "scene.gltf"])
def test_a_quad_in_both_containers(tmp_path, name):
    scene = one(quad(name="q"), tmp_path, name)
    (shape,) = scene.shapes
    np.testing.assert_array_equal(shape.mesh.positions, QUAD)
    np.testing.assert_array_equal(shape.mesh.triangles, TWO.reshape(-1, 3))
    np.testing.assert_array_equal(shape.mesh.normals, UP)
    np.testing.assert_array_equal(shape.mesh.texcoords[0], QUAD_UV)
    assert shape.name == "q"
    assert (shape.material.metallic, shape.material.roughness) == (1, 1)  # glTF's default material
    assert CAMERA_NOTE in scene.notes and LIGHTS_NOTE in scene.notes


def test_a_buffer_in_a_file_of_its_own_with_an_escaped_name(tmp_path):
    writer = quad()
    (tmp_path / "my data.bin").write_bytes(writer.binary)
    writer.content["buffers"][0]["uri"] = "my%20data.bin"
    assert len(one(writer, tmp_path, "scene.gltf").shapes) == 1


def test_hierarchy_of_matrix_and_trs(tmp_path):
    writer = Writer()
    half = np.sqrt(0.5)
    child = writer.node(root=False, mesh=writer.mesh(), rotation=[0, 0, half, half], scale=[2, 1, 1])
    lifted = np.eye(4)
    lifted[:3, 3] = 0, 5, 0
    writer.node(matrix=lifted.T.ravel().tolist(), children=[child])
    shape = one(writer, tmp_path).shapes[0]
    np.testing.assert_allclose(shape.matrix @ [1, 0, 0, 1], [0, 7, 0, 1], atol=1e-12)
    np.testing.assert_allclose(shape.matrix @ [0, 1, 0, 1], [-1, 5, 0, 1], atol=1e-12)


def test_a_mirrored_node_keeps_its_fronts(tmp_path):
    shape = one(quad(scale=[-1, 1, 1]), tmp_path).shapes[0]
    a, b, c = (shape.world.positions[shape.world.triangles[:, i]] for i in range(3))
    np.testing.assert_allclose(np.cross(b - a, c - a), [[0, 0, 1]] * 2)
    np.testing.assert_allclose(shape.world.normals, UP)


def test_interleaved_views(tmp_path):
    writer = Writer()
    rows = np.concatenate([QUAD, UP, QUAD_UV], axis=1, dtype=np.float32)
    view = writer.view(rows.tobytes(), byteStride=32)
    names = (("POSITION", "VEC3", 0), ("NORMAL", "VEC3", 12), ("TEXCOORD_0", "VEC2", 24))
    for _, kind, offset in names:
        writer.content["accessors"].append(
            {"bufferView": view, "byteOffset": offset, "componentType": 5126, "count": 4, "type": kind}
        )
    writer.node(mesh=writer.mesh(**{name: index for index, (name, _, _) in enumerate(names)}))
    mesh = one(writer, tmp_path).shapes[0].mesh
    np.testing.assert_array_equal(mesh.positions, QUAD)
    np.testing.assert_array_equal(mesh.normals, UP)
    np.testing.assert_array_equal(mesh.texcoords[0], QUAD_UV)


def test_sparse_values_replace_some(tmp_path):
    writer = Writer()
    sparse = {
        "count": 2,
        "indices": {"bufferView": writer.view(np.uint8([1, 2]).tobytes()), "componentType": 5121},
        "values": {"bufferView": writer.view(np.float32([[3, 0, 0], [3, 3, 0]]).tobytes())},
    }
    position = writer.accessor(QUAD, sparse=sparse)
    writer.node(mesh=writer.mesh(POSITION=position))
    mesh = one(writer, tmp_path).shapes[0].mesh
    np.testing.assert_array_equal(mesh.positions, [[0, 0, 0], [3, 0, 0], [3, 3, 0], [0, 1, 0]])
    assert mesh.normals is None  # flat


def test_sparse_without_a_view_starts_from_zero(tmp_path):
    writer = Writer()
    writer.content["accessors"].append(
        {
            "componentType": 5126, "count": 3, "type": "VEC3",
            "sparse": {
                "count": 2,
                "indices": {"bufferView": writer.view(np.uint16([1, 2]).tobytes()), "componentType": 5123},
                "values": {"bufferView": writer.view(np.float32([[1, 0, 0], [0, 1, 0]]).tobytes())},
            },
        }
    )  # fmt: skip
    writer.node(mesh=writer.mesh(indices=None, POSITION=0))
    assert one(writer, tmp_path).shapes[0].mesh.positions.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]]


def test_normalised_integers(tmp_path):
    writer = Writer()
    uv = writer.accessor(np.uint16([[0, 65535], [65535, 65535], [65535, 0], [0, 0]]), normalized=True)
    up = writer.accessor(np.int8([[0, 0, 127, 0]] * 4)[:, :3].copy(), normalized=True)
    color = writer.accessor(np.uint8([[255, 0, 51, 255]] * 4), normalized=True)
    writer.node(mesh=writer.mesh(POSITION=QUAD, NORMAL=up, TEXCOORD_0=uv, COLOR_0=color))
    mesh = one(writer, tmp_path).shapes[0].mesh
    np.testing.assert_array_equal(mesh.texcoords[0], QUAD_UV)
    np.testing.assert_array_equal(mesh.normals, UP)
    np.testing.assert_allclose(mesh.colors, [[1, 0, 0.2, 1]] * 4, atol=1e-7)


def test_strip_and_fan_face_the_same_way(tmp_path):
    writer = Writer()
    strip = writer.mesh(np.uint8([0, 1, 3, 2]), POSITION=QUAD)
    fan = writer.mesh(np.uint8([0, 1, 2, 3]), POSITION=QUAD)
    writer.content["meshes"][strip]["primitives"][0]["mode"] = 5
    writer.content["meshes"][fan]["primitives"][0]["mode"] = 6
    writer.node(mesh=strip)
    writer.node(mesh=fan)
    for shape in one(writer, tmp_path).shapes:
        a, b, c = (shape.mesh.positions[shape.mesh.triangles[:, i]] for i in range(3))
        np.testing.assert_array_equal(np.cross(b - a, c - a), [[0, 0, 1]] * 2)


@pytest.mark.parametrize(("mode", "word"), [(0, "points"), (1, "lines"), (3, "line strip")])
def test_what_is_no_surface_is_listed(tmp_path, mode, word):
    writer = quad()
    extra = writer.mesh()
    writer.content["meshes"][extra]["primitives"][0]["mode"] = mode
    writer.node(mesh=extra)
    scene = one(writer, tmp_path)
    assert len(scene.shapes) == 1
    assert any(word in note and "left out" in note for note in scene.notes)


def test_normals_without_length_are_replaced(tmp_path):
    writer = Writer()
    writer.node(mesh=writer.mesh(POSITION=QUAD, NORMAL=np.float32([[0, 0, 2], [0, 0, 0], [0, 0, 1], [0, 0, 0]])))
    scene = one(writer, tmp_path)
    np.testing.assert_array_equal(scene.shapes[0].mesh.normals, UP)
    assert any("2 normals without length" in note for note in scene.notes)


def test_the_first_camera_or_the_one_asked_for(tmp_path):
    writer = quad()
    writer.content["cameras"] = [
        {"type": "perspective", "name": "wide", "perspective": {"yfov": 1.2, "znear": 0.1}},
        {"type": "orthographic", "orthographic": {"xmag": 9, "ymag": 2, "znear": 0, "zfar": 7}},
    ]
    writer.node(camera=1, name="top", translation=[0, 0, 3])
    writer.node(camera=0, translation=[0, 0, 5], scale=[2, 2, 2])
    path = writer.save(tmp_path)
    first = load(path)
    assert (first.camera.name, first.camera.yfov, first.camera.near) == ("wide", 1.2, 0.1)
    assert first.camera.far == pytest.approx(5 * 1.01)
    np.testing.assert_allclose(first.camera.matrix[:3, :3], np.eye(3))  # the scale is ignored
    np.testing.assert_allclose(first.camera.position, [0, 0, 5])
    assert any("2 cameras" in note for note in first.notes)
    for asked in (1, "1", "top"):
        camera = load(path, camera=asked).camera
        assert (camera.ymag, camera.far, camera.yfov) == (2, 7, None)
        assert camera.near > 0


def test_lights(tmp_path):
    writer = quad()
    writer.content["extensionsUsed"] = ["KHR_lights_punctual"]
    lights = [
        {"type": "point", "color": [1, 0.5, 0], "intensity": 8, "range": 3},
        {"type": "spot", "name": "s", "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.3}},
        {"type": "directional", "intensity": 2},
    ]
    writer.content["extensions"] = {"KHR_lights_punctual": {"lights": lights}}
    half = np.sqrt(0.5)
    for index in range(3):
        extensions = {"KHR_lights_punctual": {"light": index}}
        writer.node(translation=[index, 2, 0], rotation=[-half, 0, 0, half], scale=[3] * 3, extensions=extensions)
    scene = one(writer, tmp_path)
    point, spot, sun = scene.lights
    assert point == PointLight("light 0", (0, 2, 0), (8, 4, 0), 3)  # the node's scale does not touch the range
    assert isinstance(spot, SpotLight) and (spot.inner, spot.outer, spot.intensity) == (0.1, 0.3, (1, 1, 1))
    assert spot.range is None
    np.testing.assert_allclose(spot.direction, (0, -1, 0), atol=1e-12)
    assert isinstance(sun, DirectionalLight) and sun.irradiance == (2, 2, 2)
    assert LIGHTS_NOTE not in scene.notes and scene.environment is None
    assert any("W/sr" in note for note in scene.notes)


@pytest.mark.parametrize(("given", "read"), [(1e30, None), (1e-30, 1e-9), (2.5, 2.5)])
def test_a_range_that_float32_cannot_square_is_held_within(tmp_path, given, read):
    writer = quad()
    writer.content["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "point", "range": given}]}}
    writer.node(extensions={"KHR_lights_punctual": {"light": 0}})
    assert one(writer, tmp_path).lights[0].range == read


def test_materials_with_every_texture(tmp_path):
    writer = Writer()
    info = {"index": writer.texture(CHECKER, wrapS=33071, wrapT=33648, minFilter=9728, magFilter=9728)}
    found = material(
        tmp_path,
        writer,
        name="m",
        pbrMetallicRoughness={
            "baseColorFactor": [0.1, 0.2, 0.3, 0.4], "baseColorTexture": info,
            "metallicFactor": 0.5, "roughnessFactor": 0.6, "metallicRoughnessTexture": info,
        },
        normalTexture=info | {"scale": 0.7},
        occlusionTexture=info | {"strength": 0.8},
        emissiveTexture=info,
        emissiveFactor=[1, 0.5, 0],
        alphaMode="MASK",
        alphaCutoff=0.25,
        doubleSided=True,
        extensions={
            "KHR_materials_emissive_strength": {"emissiveStrength": 4},
            "KHR_materials_specular": {"specularFactor": 0.3},
        },
    )  # fmt: skip
    assert found.base_color == (0.1, 0.2, 0.3) and found.alpha == 0.4
    assert (found.metallic, found.roughness, found.specular) == (0.5, 0.6, 0.3)
    assert (found.normal_scale, found.occlusion_strength) == (0.7, 0.8)
    assert found.emissive == (4, 2, 0)
    assert (found.alpha_mode, found.alpha_cutoff, found.double_sided) == ("mask", 0.25, True)
    textures = found.textures
    assert set(textures) == {"base_color", "metallic_roughness", "normal", "occlusion", "emissive"}
    assert {slot for slot, texture in textures.items() if texture.srgb} == {"base_color", "emissive"}
    texture = textures["normal"]
    assert (texture.wrap_u, texture.wrap_v, texture.min_filter, texture.mag_filter) == (
        "clamp", "mirror", "nearest", "nearest",
    )  # fmt: skip
    assert texture.image.texels[0, 1].tolist() == [0, 255, 0]  # row 0 is the top
    assert textures["base_color"].image is texture.image  # read once


def test_texture_transform_with_another_set_of_coordinates(tmp_path):
    writer = Writer()
    transform = {"offset": [0.5, 0.25], "rotation": 0.5, "scale": [2, 3], "texCoord": 1}
    info = {"index": writer.texture(CHECKER), "extensions": {"KHR_texture_transform": transform}}
    mesh = writer.mesh(
        material={"pbrMetallicRoughness": {"baseColorTexture": info}},
        POSITION=QUAD, NORMAL=UP, TEXCOORD_0=QUAD_UV, TEXCOORD_1=QUAD_UV * np.float32(2),
    )  # fmt: skip
    writer.node(mesh=mesh)
    texture = one(writer, tmp_path).shapes[0].material.textures["base_color"]
    assert (texture.offset, texture.rotation, texture.scale, texture.texcoord) == ((0.5, 0.25), 0.5, (2, 3), 1)


def test_a_texture_without_its_coordinates_is_left_out_with_a_note(tmp_path):
    writer = Writer()
    info = {"index": writer.texture(CHECKER), "texCoord": 1}
    writer.node(mesh=writer.mesh(material={"pbrMetallicRoughness": {"baseColorTexture": info}}))
    scene = one(writer, tmp_path)
    assert not scene.shapes[0].material.textures
    assert any("lacks texture coordinates 1" in note for note in scene.notes)


def test_tangents_are_derived_for_a_normal_texture_even_on_a_flat_mesh(tmp_path):
    writer = Writer()
    bumpy = {"normalTexture": {"index": writer.texture(CHECKER)}}
    writer.node(mesh=writer.mesh(material=bumpy, POSITION=QUAD, TEXCOORD_0=QUAD_UV))
    mesh = one(writer, tmp_path).shapes[0].mesh
    assert len(mesh.positions) == 6
    np.testing.assert_allclose(mesh.tangents, [[1, 0, 0, 1]] * 6, atol=1e-6)


def test_given_tangents_are_kept(tmp_path):
    writer = Writer()
    bumpy = {"normalTexture": {"index": writer.texture(CHECKER)}}
    given = np.float32([[0, 2, 0, -1]] * 4)
    writer.node(mesh=writer.mesh(material=bumpy, POSITION=QUAD, NORMAL=UP, TEXCOORD_0=QUAD_UV, TANGENT=given))
    np.testing.assert_array_equal(one(writer, tmp_path).shapes[0].mesh.tangents, [[0, 1, 0, -1]] * 4)


def test_blended_shapes_are_left_out_of_both_sides_and_named(tmp_path):
    writer = quad()
    glass = {"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5]}}
    pane = writer.mesh(material=glass)
    writer.node(mesh=pane, name="window")
    writer.node(mesh=pane, name="other window")
    writer.node(mesh=writer.mesh(material={"alphaMode": "BLEND"}), name="really opaque")
    scene = one(writer, tmp_path)
    assert [shape.name for shape in scene.shapes] == ["node 0", "really opaque"]
    (note,) = [note for note in scene.notes if "alpha-blended" in note]
    assert "window, other window" in note and "says nothing about them" in note


def test_what_is_not_read_is_listed(tmp_path):
    writer = Writer()
    coat = {
        "extensions": {"KHR_materials_iridescence": {}, "KHR_materials_specular": {"specularColorFactor": [1, 0, 0]}}
    }
    writer.node(mesh=writer.mesh(material=coat), skin=0)
    writer.content["meshes"][0]["primitives"][0]["targets"] = [{}]
    writer.content |= {"animations": [{}], "skins": [{"joints": [0]}], "extensionsUsed": ["EXT_unheard_of"]}
    notes = " | ".join(one(writer, tmp_path).notes)
    for word in ("iridescence", "specularColorFactor", "morph", "animations", "skins", "EXT_unheard_of"):
        assert word in notes


def test_a_clear_coat_is_read_and_one_of_factor_0_is_none(tmp_path):
    def coated(**coat):
        writer = Writer()
        material = {"extensions": {"KHR_materials_clearcoat": coat}, "emissiveFactor": [0.5] * 3}
        writer.node(mesh=writer.mesh(material=material))
        return one(writer, tmp_path)

    scene = coated(clearcoatFactor=0.75, clearcoatRoughnessFactor=0.25)
    material = scene.shapes[0].material
    assert (material.clearcoat, material.clearcoat_roughness, material.left_out) == (0.75, 0.25, ())
    assert any("does not darken its emission" in note for note in scene.notes)
    scene = coated(clearcoatRoughnessFactor=0.25, clearcoatTexture={"index": 99})
    assert not scene.shapes[0].material.layers and not any("darken" in note for note in scene.notes)
    with pytest.raises(SceneError, match="clearcoatFactor"):
        coated(clearcoatFactor=1.5)


def test_an_unsupported_texture_format_is_listed(tmp_path):
    writer = Writer()
    writer.content["images"] = [{"uri": "a.ktx2"}]
    writer.content["textures"] = [{"extensions": {"KHR_texture_basisu": {"source": 0}}}]
    writer.content["extensionsUsed"] = ["KHR_texture_basisu"]
    writer.node(mesh=writer.mesh(material={"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}))
    scene = one(writer, tmp_path)
    assert any("KTX2" in note and "textures[0]" in note for note in scene.notes)
    assert not scene.shapes[0].material.textures


def test_even_emission_is_light_and_a_glowing_texture_is_not(tmp_path):
    writer = Writer()
    writer.node(mesh=writer.mesh(material={"emissiveFactor": [1, 1, 1]}))
    assert LIGHTS_NOTE not in one(writer, tmp_path).notes
    writer = Writer()
    lamp = {"emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": writer.texture(CHECKER)}}
    writer.node(mesh=writer.mesh(material=lamp))
    assert LIGHTS_NOTE in one(writer, tmp_path).notes


def test_meshes_and_materials_are_shared_between_nodes(tmp_path):
    writer = quad()
    writer.node(mesh=0, translation=[2, 0, 0])
    first, second = one(writer, tmp_path).shapes
    assert first.mesh is second.mesh and first.material is second.material


def test_a_node_scaled_to_nothing_is_left_out(tmp_path):
    writer = quad()
    writer.node(mesh=0, name="gone", scale=[1, 0, 1])
    scene = one(writer, tmp_path)
    assert len(scene.shapes) == 1 and any(note.startswith("gone is left out") for note in scene.notes)


def test_whole_numbers_may_be_written_with_a_point(tmp_path):
    writer = quad()
    path = writer.save(tmp_path, "scene.gltf")
    content = json.loads(path.read_text())
    content["accessors"][0]["count"] = 4.0
    path.write_text(json.dumps(content))
    assert len(load(path).shapes[0].mesh.positions) == 4
