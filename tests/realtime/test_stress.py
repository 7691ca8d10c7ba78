"""The stress search finds planted faults, and says what they are, in which function, and at which input."""

import numpy as np
import pytest

from lightmeter.realtime.shared_twins import alpha, color, cosine, stack, towards
from lightmeter.realtime.stress.findings import Stressed
from lightmeter.realtime.stress.ggx_forms import FORMS, curves, least_alpha
from lightmeter.realtime.stress.naming import named, of_effects, subjects
from lightmeter.realtime.stress.search import Stress
from lightmeter.realtime.twin import Argument, Twin, uniform
from lightmeter.scenes.optics import microfacet

SMALL = {"designed": 2048, "generations": 2, "children": 512}


def stressed(device, tmp_path, glsl: str, twin: Twin, **given) -> Stressed:
    (tmp_path / twin.file).write_text(glsl)
    return Stress(device, f"planted/{twin.function}", twin, tmp_path).run(**(SMALL | given))


def sound(device, tmp_path, glsl: str, twin: Twin) -> bool:
    """Whether nothing is found that is not finite or wrongly negative, in any regime."""
    return all(cell.fault == "" for cell in stressed(device, tmp_path, glsl, twin).cells["fp32"].values())


def textbook(n_dot_h, a):
    """Of the float32 cosine itself: 1 − (n·h)² in float64 keeps its digits."""
    return microfacet.d_ggx(n_dot_h, (1 - n_dot_h) * (1 + n_dot_h), a)


# precise: this driver's compiler knows x·(y − 1) + 1 as an interpolation and mends it.
TEXTBOOK = """float planted(float n_dot_h, float alpha) {
    precise float a2 = alpha * alpha;
    precise float d = n_dot_h * n_dot_h * (a2 - 1.0) + 1.0;
    return a2 / (3.14159265 * d * d);
}
"""


def test_textbook_ggx_without_guard_loses_its_digits_and_divides_by_zero(device, tmp_path):
    twin = Twin("planted.glsl", "planted", "float", (cosine("n_dot_h"), alpha("alpha")), textbook, 10, "")
    found = stressed(device, tmp_path, TEXTBOOK, twin)
    cells = found.cells["fp32"]
    assert cells["α ≥ 0.1"].digits > 4
    assert cells["α ≥ 1e-06"].fault in ("inf", "NaN")
    example = cells["α ≥ 1e-06"].example
    assert example.inputs["n_dot_h"][0] == pytest.approx(1, abs=1e-6) and example.inputs["alpha"][0] < 1e-5
    # d = sin² + α² near the peak, where 1 − (n·h)² is known to ε/2 and α² − 1 to as much: 1 % of D is half a percent
    # of d, so that α² must exceed about 200·ε, α about 5e-3. Small α is what fails, not large.
    assert 1e-3 < found.safe["α"] < 3e-2


def test_schlick_with_a_negative_base_is_not_a_number(device, tmp_path):
    glsl = "float planted(float v_dot_h, float f0) { return f0 + (1.0 - f0) * pow(1.0 - v_dot_h, 5.0); }"
    twin = Twin(
        "planted.glsl",
        "planted",
        "float",
        (cosine("v_dot_h"), Argument("f0", "float", uniform(0, 1), (0.0, 1.0))),
        lambda c, f0: f0 + (1 - f0) * np.clip(1 - c, 0, 1) ** 5,
        10,
        "",
    )
    cell = stressed(device, tmp_path, glsl, twin).cells["fp32"]["cosine > 1"]
    assert cell.fault == "NaN" and cell.example.inputs["v_dot_h"][0] > 1
    assert sound(device, tmp_path, glsl.replace("1.0 - v_dot_h,", "max(1.0 - v_dot_h, 0.0),"), twin)


def test_division_by_a_cosine_without_epsilon_is_infinite(device, tmp_path):
    glsl = "float planted(float n_dot_v, float n_dot_l) { return min(n_dot_l, 1.0) / n_dot_v; }"
    twin = Twin(
        "planted.glsl",
        "planted",
        "float",
        (cosine("n_dot_v"), cosine("n_dot_l")),
        lambda v, l: np.minimum(l, 1) / np.maximum(v, 1e-7),  # noqa: E741
        10,
        "",
    )
    cell = stressed(device, tmp_path, glsl, twin).cells["fp32"]["cosine ≤ 0"]
    assert cell.counts["inf"] + cell.counts["NaN"] > 0
    assert any(example.inputs["n_dot_v"][0] == 0 for example in cell.faults.values())
    assert sound(device, tmp_path, glsl.replace("/ n_dot_v", "/ max(n_dot_v, 1e-7)"), twin)


def test_an_unclamped_acos_is_not_a_number(device, tmp_path):
    glsl = "float planted(float cos_theta) { return acos(cos_theta); }"
    arguments = (cosine("cos_theta"),)
    twin = Twin("planted.glsl", "planted", "float", arguments, lambda c: np.arccos(np.clip(c, -1, 1)), 4096, "")
    cell = stressed(device, tmp_path, glsl, twin).cells["fp32"]["cosine > 1"]
    # A driver's acos may return a number there; then its error shows.
    assert cell.fault == "NaN" or cell.digits < 3
    assert cell.example.inputs["cos_theta"][0] > 1
    assert sound(device, tmp_path, glsl.replace("acos(cos_theta)", "acos(clamp(cos_theta, -1.0, 1.0))"), twin)


def test_a_normal_map_decoded_to_length_0_is_not_a_number(device, tmp_path):
    glsl = "vec3 planted(vec3 mapped) { return mapped * inversesqrt(dot(mapped, mapped)); }"
    mapped = Argument("mapped", "vec3", uniform(-1, 1, 3), ((0.0, 0.0, 0.0), (0.0, 0.0, 1.0)))

    def unit(v):
        length = np.linalg.norm(v, axis=0)
        return np.where(length > 0, v / np.where(length > 0, length, 1), 0)

    twin = Twin("planted.glsl", "planted", "vec3", (mapped,), unit, 10, "")
    cell = stressed(device, tmp_path, glsl, twin).cells["fp32"]["ordinary"]
    assert cell.fault == "NaN" and cell.example.inputs["mapped"] == [0, 0, 0]
    right = glsl.replace("{ return", "{ if (mapped == vec3(0.0)) return mapped; return")
    assert stressed(device, tmp_path, right, twin).cells["fp32"]["ordinary"].fault == ""


def test_a_half_float_target_overflows_where_the_peak_exceeds_it(device):
    """D's peak is 1/(πα²), above 65,504 for α below 2.2e-3, roughness 0.047; infinite there, or held at 65,504."""
    (subject,) = named("shared/d_ggx", subjects())
    stress = Stress(device, subject.name, subject.twin, subject.folder)
    peak = [np.array([[1.0]]), np.array([[0.0]])]
    below, above = (stress.at([*peak, np.array([[a]])])["fp16"] for a in (2.1e-3, 2.3e-3))
    # At 2.1e-3 the peak is 72,180, by a tenth too large; 11 bits keep 3.3 digits.
    assert below.digits < 1.2 and above.digits > 3.2
    cells = stress.run(**SMALL).cells
    assert cells["fp16"]["α ≥ 0.0001"].digits < 1 and cells["fp16"]["α ≥ 0.01"].digits > 3
    assert cells["fp32"]["α ≥ 0.0001"].digits > 6


def test_a_light_beyond_256_m_vanishes_in_mediump(device):
    """Its distance squared is beyond 65,504, and one over that 0: the direction to it is lost as well."""
    (subject,) = named("from_position", subjects())
    stress = Stress(device, subject.name, subject.twin, subject.folder)
    near, far = (stress.at([np.array([[0.0], [0.0], [z]]), np.zeros((3, 1))]) for z in (255.0, 256.0))
    assert near["mediump"].digits > 3
    assert far["mediump"].got == [0, 0, 0, 0] and far["mediump"].digits == 0
    assert far["fp32"].digits > 6 and far["fp16"].digits > 3


def test_the_half_vector_of_opposite_directions_is_finite(device):
    """The guard under its root was once a denormal, which a device may flush to 0."""
    (subject,) = named("half_cosines", subjects())
    stress = Stress(device, subject.name, subject.twin, subject.folder)
    v = np.array([[0.6], [0.0], [0.8]])
    assert np.isfinite(stress.at([np.array([[0.0], [0.0], [1.0]]), v, -v])["fp32"].got).all()


def test_a_run_is_repeatable(device):
    (subject,) = named("shared/f_schlick", subjects())
    first, second = (Stress(device, subject.name, subject.twin, subject.folder, 3).run(**SMALL) for _ in range(2))
    assert first == second


def test_an_effect_is_stressed_with_the_files_it_includes():
    names = {subject.name for subject in of_effects(["cook_torrance"])}
    assert {"cook_torrance/reflected", "shared/d_ggx", "shared/from_position"} <= names
    assert "oren_nayar/lean" not in names


def test_directions_that_are_no_units_are_told_from_grazing_ones(device):
    from lightmeter.realtime.stress.regimes import marks_of

    n = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [1.0, 0.5, 0.0]])
    v = np.array([[1.0, 1.0, 1.0], [0.0, 0.0, 0.0], [1e-5, 0.0, 0.0]])
    marks = marks_of([towards("n"), towards("v")], [n, v]).lanes
    assert marks["grazing"].tolist() == [True, False, False]
    assert marks["not unit"].tolist() == [False, True, False]
    assert marks["zero vector"].tolist() == [False, False, True]
    both = marks_of([color("f0"), alpha("alpha")], [stack(*[np.array([2.0])] * 3), np.array([[1e-6]])]).lanes
    assert not both["α ≥ 1e-06"].any() and not both["beyond 0…1"].any()


def test_the_textbooks_ggx_loses_two_digits_a_decade_and_the_cross_product_one(device):
    """Near the peak the textbook knows 1 − (n·h)² to ε, of a size of α²; |n × h| is known to ε, of a size of α."""
    found = {(c.form, c.arithmetic): c for c in curves(device, [1e-3, 1e-2, 1e-1], lanes=1024)}
    textbook_digits, cross_digits = (np.array(found[form, "fp32"].digits) for form in FORMS)
    assert np.diff(textbook_digits) == pytest.approx([2, 2], abs=0.6)
    assert np.diff(cross_digits) == pytest.approx([1, 1], abs=0.4)
    assert least_alpha(found["ggx_textbook", "fp32"], 2.0) == 1e-2
    assert least_alpha(found["ggx_cross", "fp32"], 4.0) == 1e-3


def test_filaments_mobile_clamp_is_where_a_flushed_half_float_keeps_the_peak(device):
    """(α·n·h)² is a normal half float, 2⁻¹⁴, from α = 2⁻⁷ up: roughness 0.0884."""
    below, above = 0.0883**2, 0.0885**2
    found = {c.arithmetic: c for c in curves(device, [below, above], lanes=16) if c.form == "ggx_cross"}
    flushed, kept = found["mediump, denormals flushed"], found["mediump"]
    assert flushed.peak[0] < 1 < 2 < flushed.peak[1]
    assert kept.peak[0] > 2


def test_the_search_climbs_to_an_error_that_the_designed_set_only_grazes(device, tmp_path):
    """A bump of 1 %, a ten-thousandth wide: 64 designed inputs meet its foot, the search its top."""
    glsl = """float planted(float x) {
        float aside = (x - 0.7310585) * 1e4;
        return x * (1.0 + 0.01 / (1.0 + aside * aside));
    }"""
    twin = Twin("planted.glsl", "planted", "float", (Argument("x", "float", uniform(0.1, 1.0)),), lambda x: x, 10, "")
    worst = [
        stressed(device, tmp_path, glsl, twin, designed=64, generations=n).largest["relative"].relative for n in (0, 8)
    ]
    assert worst[0] < 0.005 and worst[1] > 0.0095
