"""Real glTF files. They are not part of the repository; without them these tests are skipped."""

from pathlib import Path

import numpy as np
import pytest

from lightmeter.scenes.framing import CAMERA_NOTE, LIGHTS_NOTE
from lightmeter.scenes.load import load

SAMPLES = Path(__file__).parents[2].parent / "shared" / "data" / "gltf"


def sample(name: str, **options):
    path = SAMPLES / name
    if not path.exists():
        pytest.skip(f"the sample {name} is not there (looked in ../shared/data/gltf)")
    return load(path, **options)


def test_the_flight_helmet():
    scene = sample("FlightHelmet/FlightHelmet.gltf")
    assert len(scene.shapes) == 5
    assert sum(len(shape.mesh.triangles) for shape in scene.shapes) == 93_986
    assert any("alpha-blended" in note and "Lenses_low" in note for note in scene.notes)
    assert CAMERA_NOTE in scene.notes and LIGHTS_NOTE in scene.notes
    for shape in scene.shapes:
        assert set(shape.material.textures) >= {"base_color", "metallic_roughness", "normal", "occlusion"}
        tangents, normals = shape.mesh.tangents, shape.mesh.normals
        np.testing.assert_allclose(np.linalg.norm(tangents[:, :3], axis=1), 1, atol=1e-3)
        assert np.median(np.abs(np.sum(tangents[:, :3] * normals, axis=1))) < 0.01
        assert set(np.unique(tangents[:, 3])) <= {-1, 1}


def test_the_helmets_own_tangents_are_close_to_the_derived_ones():
    """An independent exporter's tangents against ours, over the parts where the image is not degenerate."""
    from dataclasses import replace

    from lightmeter.scenes.tangents import with_tangents

    scene = sample("FlightHelmet/FlightHelmet.gltf")
    for shape in scene.shapes:
        given = shape.mesh
        derived = with_tangents(replace(given, tangents=None))
        theirs = given.tangents[given.triangles].reshape(-1, 4)
        ours = derived.tangents[derived.triangles].reshape(-1, 4)
        assert np.mean(theirs[:, 3] == ours[:, 3]) > 0.99
        cosines = np.sum(theirs[:, :3] * ours[:, :3], axis=1)
        assert np.median(cosines) > 0.999
        assert np.mean(cosines > 0.95) > 0.95


def test_the_shader_ball():
    scene = sample("ShaderBall/shaderball.glb")
    assert sum(len(shape.mesh.triangles) for shape in scene.shapes) == 88_264
    assert any("FB_ngon_encoding" in note for note in scene.notes)


def test_the_texture_transforms():
    scene = sample("TextureTransformTest/TextureTransformTest.gltf")
    textures = [s.material.base_color_texture for s in scene.shapes if s.material.base_color_texture]
    assert len(scene.shapes) == 12
    assert any(t.rotation for t in textures) and any(t.offset != (0, 0) for t in textures)
    assert not any("transform" in note for note in scene.notes)


def test_the_cameras():
    scene = sample("Cameras/Cameras.gltf")
    assert scene.camera.yfov == pytest.approx(0.7) and scene.camera.ymag is None
    assert scene.shapes[0].material.metallic == 1  # no materials: glTF's default
    assert scene.shapes[0].mesh.normals is None
    assert CAMERA_NOTE not in scene.notes and LIGHTS_NOTE in scene.notes
    second = sample("Cameras/Cameras.gltf", camera=1)
    assert second.camera.ymag == 1 and second.camera.yfov is None


def test_the_clear_coats_are_read():
    scene = sample("ClearCoatTest/ClearCoatTest.gltf")
    assert not any("clearcoat" in note for note in scene.notes)
    coated = {s.material.name: s.material for s in scene.shapes if s.material.clearcoat > 0}
    assert len(coated) == 6 and all(material.clearcoat == 1 and not material.left_out for material in coated.values())
    found = {name: sorted(material.textures) for name, material in coated.items()}
    assert found["Simple_Coated"] == [] and found["Partial_Coated"] == ["clearcoat"]
    assert found["RoughVariations_Coated"] == ["clearcoat_roughness"] and found["BaseNorm_Coated"] == ["normal"]
    assert found["CoatNorm_Coated"] == ["clearcoat_normal"]
    assert found["SharedNorm_Coated"] == ["clearcoat_normal", "normal"]
