"""Dielectric solids: Fresnel and Snell by closed forms, the material's rules, the brilliant's facets, files."""

import numpy as np
import pytest

from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.glass import glass
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Material
from lightmeter.scenes.moving import scaled
from lightmeter.scenes.optics import dielectric
from lightmeter.scenes.shapes.brilliant import brilliant

ETAS = (1.33, 1.5, 2.417)


@pytest.mark.parametrize("eta", ETAS)
def test_fresnel_s_closed_forms(eta):
    assert dielectric.reflectance(1.0, eta) == pytest.approx(((eta - 1) / (eta + 1)) ** 2)
    assert dielectric.reflectance(0.0, eta) == pytest.approx(1.0)
    # At Brewster's angle, tan θ = η, one polarisation is not mirrored, the other as sin²(θ − θ').
    angle = np.arctan(eta)
    assert dielectric.reflectance(np.cos(angle), eta) == pytest.approx(0.5 * np.sin(2 * angle - np.pi / 2) ** 2)
    # Stokes: as much is mirrored from within, at the refracted angle.
    cosine = np.linspace(0.01, 1, 50)
    beyond = dielectric.cosine_beyond(cosine, eta)
    np.testing.assert_allclose(dielectric.reflectance(beyond, 1 / eta), dielectric.reflectance(cosine, eta), rtol=1e-9)


@pytest.mark.parametrize("eta", ETAS)
def test_beyond_the_critical_angle_all_is_mirrored(eta):
    critical = np.arcsin(1 / eta)
    assert dielectric.reflectance(np.cos(critical + 1e-6), 1 / eta) == 1
    assert dielectric.reflectance(np.cos(critical - 1e-6), 1 / eta) < 0.999


@pytest.mark.parametrize("eta", [*ETAS, 1 / 1.5])
def test_snell_s_law(eta):
    rng = np.random.default_rng(0)
    normal, view = (v / np.linalg.norm(v, axis=0) for v in rng.normal(size=(2, 3, 200)))
    view = np.where(np.sum(normal * view, axis=0) > 0, view, -view)
    cosine = np.sum(normal * view, axis=0)
    going = 1 - cosine**2 < eta**2 * 0.999
    through = dielectric.refracted(normal, view, cosine, eta)[:, going]
    np.testing.assert_allclose(np.linalg.norm(through, axis=0), 1, rtol=1e-9)
    across = np.linalg.norm(np.cross(normal[:, going], through, axis=0), axis=0)
    np.testing.assert_allclose(np.linalg.norm(np.cross(normal, view, axis=0), axis=0)[going], eta * across, rtol=1e-9)
    assert (np.sum(through * normal[:, going], axis=0) < 0).all()
    planar = np.sum(np.cross(normal, view, axis=0)[:, going] * through, axis=0)
    np.testing.assert_allclose(planar, 0, atol=1e-12)


def test_a_solid_s_surface_scatters_nothing_else():
    with pytest.raises(ValueError, match="no base colour"):
        Material("glass", (0.5, 0.5, 0.5), ior=1.5)
    made = glass("green", 1.5, (0.5, 0.8, 0.25), 2.0)
    np.testing.assert_allclose(made.absorption, -np.log([0.5, 0.8, 0.25]) / 2)


def test_a_larger_solid_absorbs_as_much():
    scene = load("glass-ball")
    ball = next(shape for shape in scene.shapes if shape.material.is_glass)
    grown = next(shape for shape in scaled(scene, 4.0).shapes if shape.material.is_glass)
    np.testing.assert_allclose(np.array(grown.material.absorption) * 4, ball.material.absorption)


def test_a_brilliant_is_closed_and_has_57_facets_and_a_girdle():
    mesh = brilliant(0.5)
    corners = mesh.positions.astype(np.float64)[mesh.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    assert (np.sum(normals * corners[:, 0], axis=1) > 0).all()
    edges = np.sort(np.concatenate([mesh.triangles[:, pair] for pair in ([0, 1], [1, 2], [2, 0])]), axis=1)
    assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()
    facets = np.unique(np.round(normals, 3), axis=0)
    slopes, counts = np.unique(np.round(np.degrees(np.arccos(np.clip(facets[:, 1], -1, 1)))), return_counts=True)
    assert dict(zip(slopes.tolist(), counts.tolist(), strict=True)) == {
        0: 1, 21: 8, 35: 8, 41: 16, 90: 32, 138: 16, 139: 8
    }  # fmt: skip


def test_toml(tmp_path):
    def loaded(material: str):
        path = tmp_path / "scene.toml"
        path.write_text(f"[materials.m]\n{material}\n[[shapes]]\ntype = 'sphere'\nmaterial = 'm'\n", encoding="utf-8")
        return load(str(path)).shapes[0].material

    made = loaded("ior = 1.7\nattenuation_color = [0.5, 1, 1]\nattenuation_distance = 2")
    assert made.ior == 1.7 and made.absorption[0] == pytest.approx(np.log(2) / 2) and made.absorption[1] == 0
    for wrong, words in (
        ("ior = 1.5\nroughness = 0.3", "has no roughness"),
        ("attenuation_color = 0.5", "give its ior"),
        ("ior = 0.9", "above 1"),
        ("ior = 1.5\nattenuation_color = [0, 1, 1]", "must be above 0"),
    ):
        with pytest.raises(SceneError, match=words):
            loaded(wrong)
