"""Planted breaches of the laws of reflection are found and told apart; what is known of our own functions comes out."""

import numpy as np
import pytest

from lightmeter.realtime.declared_twins import declared_twins
from lightmeter.realtime.shared_twins import color, cosine, towards
from lightmeter.realtime.stress.laws import ALBEDO, RECIPROCITY, Laws, hold_laws, law
from lightmeter.realtime.stress.naming import Subject, named, subjects
from lightmeter.realtime.twin import Argument, Brdf, Twin, uniform


def planted(tmp_path, glsl: str, arguments, python, brdf: Brdf, result: str = "float") -> Subject:
    (tmp_path / "planted.glsl").write_text(glsl)
    twin = Twin("planted.glsl", "planted", result, arguments, python, 10, "", brdf=brdf)
    return Subject("planted/planted", twin, tmp_path)


def our(name: str) -> Subject:
    (subject,) = named(name, subjects())
    return subject


def held(device, subject: Subject) -> Laws:
    found = hold_laws(device, subject)
    assert found is not None
    return found


def lane(**given: float | tuple[float, ...]) -> list[np.ndarray]:
    return [np.reshape(value, (-1, 1)).astype(np.float64) for value in given.values()]


def dimmed(n_dot_l):
    """Lambert's base under Schlick's F of the light's angle alone, F0 = 0.04."""
    return (1 - (0.04 + 0.96 * np.clip(1 - n_dot_l, 0, 1) ** 5)) / np.pi


ONE_SIDED = """vec3 planted(vec3 rho, vec3 n, vec3 l) {
    float c = max(dot(n, l), 0.0);
    return rho * (0.96 - 0.96 * pow(1.0 - min(c, 1.0), 5.0)) * 0.318309886 * c;
}"""


def test_a_base_dimmed_by_the_lights_angle_alone_is_not_reciprocal(device, tmp_path):
    """It takes no view: the law asks what it gives with light and viewer in each other's place all the same."""
    subject = planted(
        tmp_path,
        ONE_SIDED,
        (color("rho"), towards("n"), towards("l")),
        lambda rho, n, light: rho * dimmed(np.sum(n * light, axis=0)) * np.maximum(np.sum(n * light, axis=0), 0),
        Brdf(view=None),
        "vec3",
    )
    found = held(device, subject)
    # Head-on 0.96, at the least cosine 0.96·(1 − 0.999⁵) = 0.0048: 0.995 of the larger.
    assert found.one_sided == "model"
    assert 0.98 < found.reciprocity["model"].model < 0.996
    assert found.reciprocity["model"].device == pytest.approx(found.reciprocity["model"].model, abs=1e-3)
    assert found.gains == ""
    # 1 − ∫ F(µ)·2µ dµ = 1 − (0.04 + 0.96/21)
    assert found.albedo is not None and found.albedo.model == pytest.approx(0.96 - 0.96 / 21, abs=1e-5)


def test_dimmed_by_both_angles_it_is_reciprocal(device, tmp_path):
    """By cosines, and f itself, without n·l."""
    glsl = """float dimmed(float c) { return 0.96 - 0.96 * pow(1.0 - clamp(c, 0.0, 1.0), 5.0); }
    float planted(float n_dot_v, float n_dot_l) { return dimmed(n_dot_v) * dimmed(n_dot_l) * 0.318309886; }"""
    subject = planted(
        tmp_path,
        glsl,
        (cosine("n_dot_v"), cosine("n_dot_l")),
        lambda v, light: dimmed(v) * dimmed(light) * np.pi,
        Brdf("n_dot_v", "n_dot_l", normal=None, cosine=False),
    )
    found = held(device, subject)
    assert (found.one_sided, found.gains) == ("", "")
    assert found.albedo is not None and found.albedo.model == pytest.approx(0.96 * (0.96 - 0.96 / 21), abs=1e-5)


def test_a_highlight_without_normalisation_makes_energy(device, tmp_path):
    """(n·h)ˢ·(n·l): at s = 0 the light of the whole sky, π, from where no view differs."""
    subject = planted(
        tmp_path,
        "float planted(float n_dot_h, float n_dot_l, float s) { return pow(n_dot_h, s) * n_dot_l; }",
        (cosine("n_dot_h"), cosine("n_dot_l"), Argument("s", "float", uniform(0.0, 100.0), (0.0,))),
        lambda h, light, s: h**s * light,
        Brdf(view=None, light="n_dot_l", normal=None),
    )
    found = law(ALBEDO, device, subject).worst()
    assert found.inputs["s"][0] == 0
    assert found.model == pytest.approx(np.pi, abs=1e-5) and found.device == pytest.approx(np.pi, abs=1e-5)
    assert found.error < 1e-4


def test_what_only_float32_breaks_is_the_devices(device, tmp_path):
    """A sum that is reciprocal, of which float32 keeps one part to 2.4e-4 only."""
    subject = planted(
        tmp_path,
        """float planted(float n_dot_v, float n_dot_l) {
            precise float far = n_dot_v + 4096.0;
            precise float near = far - 4096.0;
            return near + n_dot_l;
        }""",
        (cosine("n_dot_v"), cosine("n_dot_l")),
        lambda v, light: v + light,
        Brdf("n_dot_v", "n_dot_l", normal=None, cosine=False, whole=False),
    )
    found = held(device, subject)
    assert found.albedo is None
    # 4096 + v is known to half of 2⁻¹¹, 2.4e-4: of a sum of two cosines of 1e-3 an eighth, of both orders' a quarter.
    assert found.one_sided == "device" and 0.05 < found.reciprocity["device"].device < 0.5
    assert found.reciprocity["model"].model < 1e-12


def test_what_the_inputs_break_is_not_the_arithmetics(device):
    """Nearly opposite unit vectors of float32 differ in length by as much as v·h and l·h have left."""
    found = held(device, our("diffuse_lobe"))
    assert found.one_sided == "inputs"
    assert found.reciprocity["device"].given > 0.01 and found.reciprocity["model"].model < 1e-6
    assert found.furthest(RECIPROCITY)[0] < 1e-6


@pytest.mark.parametrize(
    ("roughness", "cosine_", "published"), [(1, 1, 0.3069), (0.5, 1, 0.9158), (0.3, 1, 0.9907), (0.5, 0.5, 0.8573)]
)
def test_white_metals_albedo(device, roughness, cosine_, published):
    """GGX, F = 1, height-correlated Smith, single scattering: of α = roughness²."""
    given = lane(base_color=(1, 1, 1), metallic=1, roughness=roughness, specular=1, n_dot_v=cosine_)
    found = law(ALBEDO, device, our("gltf_brdf")).at(given)
    assert found.model == pytest.approx(published, abs=5e-5) and found.device == pytest.approx(published, abs=6e-5)


def test_gltfs_white_plastic_makes_energy_and_its_metal_does_not(device):
    """The base is dimmed by Fresnel at v·h, not at the surface's own angles (docs/shading-models.md: 1.535 at 0.1)."""
    subject = our("gltf_brdf")
    at = law(ALBEDO, device, subject).at(lane(base_color=(1, 1, 1), metallic=0, roughness=0.1, specular=1, n_dot_v=0.1))
    assert at.device == pytest.approx(1.535, abs=1e-3)
    found = held(device, subject)
    assert found.gains == "model" and found.albedo is not None and found.albedo.model > 1.85
    assert found.albedo.inputs["metallic"][0] < 0.1 and found.albedo.inputs["n_dot_v"][0] < 0.02
    assert found.one_sided == ""
    metal = held(device, our("specular_lobe"))
    assert metal.gains == "" and metal.albedo is not None and metal.albedo.model > 0.9999


def test_phong_of_1975_breaks_both_and_its_normalised_form_neither_on_metal(device):
    old = held(device, our("phong/phong#2"))
    assert (old.one_sided, old.gains) == ("model", "model")
    # At exponent 0 a white metal's highlight is 1/π over the hemisphere, from straight above: 2π/π.
    assert old.albedo is not None and old.albedo.model == pytest.approx(2, abs=1e-3)
    new = held(device, our("phong/phong"))
    assert new.one_sided == ""
    # A plastic's base is not dimmed by what the highlight takes, F0 = 0.04.
    assert new.albedo is not None and new.albedo.model == pytest.approx(1.04, abs=1e-4)


def test_a_coat_that_dims_by_the_view_alone_is_not_reciprocal(device):
    """KHR_materials_clearcoat's mix by F(n·v). Without a coat it is the Lambert base that is put below, and is."""
    reciprocity = law(RECIPROCITY, device, our("coated"))
    way = {"n": (0, 0, 1), "v": (0.6, 0, 0.8), "l": (0, 0.99, np.sqrt(1 - 0.99**2))}
    coat, bare = (reciprocity.at(lane(base=(0.2, 0.2, 0.2), clearcoat=c, roughness=0.3, **way)) for c in (1.0, 0.0))
    assert coat.model > 0.1 and coat.device == pytest.approx(coat.model, abs=1e-5)
    assert bare.model < 1e-6 and bare.device < 1e-5


def test_what_declares_nothing_has_no_law(device):
    assert hold_laws(device, our("shared/d_ggx")) is None


def test_a_search_is_repeatable(device):
    assert held(device, our("lambert")) == held(device, our("lambert"))


def test_declarations_name_arguments():
    for _, twin in declared_twins():
        if twin.brdf:
            names = {argument.name for argument in twin.arguments}
            brdf = twin.brdf
            wanted = {brdf.view, brdf.light, brdf.normal, brdf.grain, brdf.below} - {None}
            assert wanted <= names, twin.function
