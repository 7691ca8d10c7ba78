"""The shading models as effects: the frame's GLSL against their float64 models, what a knob costs, and what they break.

Functions are held against their twins to rounding (test_glsl_twins.py). Here each effect runs as a whole, through its
uniforms, tables and permutations, so that one knob taken for another or a missing factor shows: to 1e-3 of the value,
and 1e-4 of the mean for pixels that hardly get light.
"""

from importlib import import_module

import numpy as np
import pytest

from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effect
from lightmeter.realtime.graph import Choice
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Material

from .direct_definition import exact_direct, inputs_of
from .small_scenes import LAMP, facing, renderer, scene_of

WHOLE = [
    ("lambert", {}),
    ("minnaert", {"exponent": 1.3}),
    *(("oren_nayar", {"form": form, "spread": 0.8}) for form in ("full", "qualitative", "fujii", "eon")),
    ("phong", {}),
    ("phong", {"normalisation": "none", "cosine": False}),
    ("blinn_phong", {}),
    ("blinn_phong", {"normalisation": "usual"}),
    ("blinn_phong", {"normalisation": "none", "cosine": False}),
    ("cook_torrance", {}),
    ("cook_torrance", {"distribution": "beckmann", "masking": "smith_separable", "fresnel": "dielectric"}),
    ("cook_torrance", {"distribution": "blinn", "masking": "schlick_half", "fresnel": "none"}),
    ("cook_torrance", {"masking": "schlick_remapped", "fresnel": "conductor", "edge_tint": 0.3}),
    ("cook_torrance", {"masking": "smith_fast", "fresnel": "conductor", "metal": "gold"}),
    ("cook_torrance", {"masking": "implicit"}),
    ("cook_torrance", {"compensation": "turquin"}),
    ("cook_torrance", {"compensation": "kulla_conty", "distribution": "beckmann"}),
]


def model_of(name: str, **given):
    """An effect's float64 model under those knobs."""
    twin = import_module(f"lightmeter.realtime.effects.{name}.twin")
    return twin.model(effect(name).settings(given))


@pytest.fixture(scope="module")
def scene():
    """The metalness × roughness grid."""
    return load("metal-rough-grid")


@pytest.mark.parametrize(("name", "knobs"), WHOLE, ids=[f"{n} {' '.join(map(str, k.values()))}" for n, k in WHOLE])
def test_the_effect_is_its_model(device, scene, name, knobs):
    """A table is looked up with weights of 8 bits on some hardware: 1/512 of the step from texel to texel, which is at
    most 0.06 of an albedo of 0.3 or more; twice that for two directions, 8e-4, is within the tolerance.
    """
    seen = renderer(device, scene, (40, 40), Choice(only=(name,), settings={name: knobs})).capture()
    light = scene.lights[0]
    exact = exact_direct(light, *inputs_of(seen.points, light), model=model_of(name, **knobs))
    found = seen.direct[0][seen.points.hit].T
    assert (found > 0).mean() > 0.5
    np.testing.assert_allclose(found, exact, rtol=1e-3, atol=1e-4 * exact.mean())


def test_all_knobs_differ():
    """Else the test above could not tell them apart: every pair of models differs by a hundredth somewhere."""
    rng = np.random.default_rng(2)
    n, v, l = rng.normal(size=(3, 3, 2000))  # noqa: E741 (l: light)
    n, v, l = (d / np.linalg.norm(d, axis=0) for d in (n, v, l))  # noqa: E741
    parameters = rng.uniform(0, 1, (3, 2000)), rng.uniform(0, 1, 2000), rng.uniform(0.2, 1, 2000), np.ones(2000)
    values = [model_of(name, **knobs)(*parameters, n, v, l) for name, knobs in WHOLE]
    for index, one in enumerate(values):
        for other in values[:index]:
            assert np.abs(one - other).max() > 0.01 * one.max()


def made(**knobs) -> dict[str, int]:
    """What a renderer of the plane makes under cook_torrance's knobs, on a device of its own."""
    device = Device()
    maker = renderer(device, load("plane"), (8, 8), Choice(settings={"cook_torrance": knobs}))
    maker.draw()
    return dict(device.counts)


def test_a_knob_that_is_not_chosen_costs_nothing(device):
    """A table is a texture more; a permutation is a shader in place of another."""
    plain = made()
    assert made(distribution="beckmann", masking="implicit", fresnel="conductor", metal="gold") == plain
    assert made(compensation="turquin") == plain | {"textures": plain["textures"] + 1}


def members(device, **knobs) -> set[str]:
    """The uniforms that cook_torrance's program really has."""
    scene = scene_of(facing(Material("half a metal", metallic=0.5)), lights=(LAMP,))
    maker = renderer(device, scene, (8, 8), Choice(settings={"cook_torrance": knobs}))
    maker.draw()
    (program, _), *_ = maker._passes["cook_torrance"]._programs.values()
    return set(program)


def test_the_shader_holds_only_what_its_knobs_read(device):
    extra = {"albedo_table", "edge_tint", "metal_n", "metal_k"}
    assert not members(device) & extra
    assert members(device, compensation="kulla_conty") & extra == {"albedo_table"}
    assert members(device, fresnel="conductor") & extra == {"edge_tint"}
    assert members(device, fresnel="conductor", metal="iron") & extra == {"metal_n", "metal_k"}


def directions(count: int = 96):
    """(3, N) half vectors' reflections of a view at 40° and 75°, and what solid angle of l each stands for."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    theta, weight = (nodes + 1) * np.pi / 4, weights * np.pi / 4
    phi = (np.arange(count) + 0.5) * 2 * np.pi / count
    theta, turn = (a.ravel() for a in np.meshgrid(theta, phi, indexing="ij"))
    solid = np.repeat(weight, count) * np.sin(theta) * 2 * np.pi / count
    return np.stack([np.sin(theta) * np.cos(turn), np.sin(theta) * np.sin(turn), np.cos(theta)]), solid


def albedo(model, cosine: float, roughness: float, metallic: float = 1.0) -> float:
    """What a white surface reflects of light from one direction (of v, where the model is not reciprocal)."""
    light, solid = directions()
    v = np.array([[np.sqrt(1 - cosine**2)], [0], [cosine]])
    up = np.array([[0.0], [0], [1]])
    ones = np.ones(1)
    value = model(np.ones((3, 1)), metallic * ones, roughness * ones, ones, up, v, light)
    return float(np.sum(value[1] * solid))


def one_sided(model, roughness: float = 0.6) -> float:
    """The largest |f(v, l) − f(l, v)| against f, of a metal."""
    light, _ = directions(24)
    v = np.roll(light, 7, axis=1)
    up = np.array([[0.0], [0], [1]])
    ones = np.ones(1)
    color = 0.7 * np.ones((3, 1))
    there, back = (model(color, ones, roughness * ones, ones, up, a, b)[1] / b[2] for a, b in ((v, light), (light, v)))
    return float((np.abs(there - back) / (np.maximum(there, back) + 1e-9)).max())


@pytest.mark.parametrize(("name", "knobs"), WHOLE, ids=[f"{n} {' '.join(map(str, k.values()))}" for n, k in WHOLE])
def test_models_are_reciprocal_but_for_those_that_are_known_not_to_be(name, knobs):
    broken = knobs.get("cosine") is False or knobs.get("compensation") == "turquin"
    found = one_sided(model_of(name, **knobs))
    assert found > 0.05 if broken else found < 1e-9


@pytest.mark.parametrize(
    ("name", "knobs", "cosine", "roughness", "expected"),
    [
        # Closed forms: ρ·2/(k + 1)·µ^(k − 1); 2 for a constant highlight of 1/π without its cosine.
        ("minnaert", {"exponent": 0.5}, 0.1, 0.5, 2 / 1.5 * 0.1**-0.5),
        ("phong", {"normalisation": "none", "cosine": False}, 1.0, 1.0, 2.0),
        ("blinn_phong", {"normalisation": "none", "cosine": False}, 0.4, 1.0, 2.0),
        # (s + 8)/(8π) over Giesen's (s + 2)(s + 4)/(8π(2^(−s/2) + s)), at s = 2.
        ("blinn_phong", {"normalisation": "usual"}, 1.0, 2**-0.25, 10 / (4 * 6 / 2.5)),
    ],
)
def test_models_that_make_energy_are_shown_to(name, knobs, cosine, roughness, expected):
    found = albedo(model_of(name, **knobs), cosine, roughness)
    assert found == pytest.approx(expected, rel=3e-3)
    assert found > 1.04


@pytest.mark.parametrize("cosine", [1.0, 0.6, 0.25])
@pytest.mark.parametrize(
    ("name", "knobs"),
    [
        ("lambert", {}),
        ("oren_nayar", {}),
        ("phong", {}),
        ("blinn_phong", {}),
        ("cook_torrance", {}),
        ("cook_torrance", {"masking": "implicit"}),
        ("cook_torrance", {"compensation": "kulla_conty"}),
    ],
)
def test_white_metals_of_the_others_return_no_more_than_they_get(name, knobs, cosine):
    for roughness in (0.5, 0.8, 1.0):
        assert 0.05 < albedo(model_of(name, **knobs), cosine, roughness) < 1.005


def test_compensation_gives_back_what_single_scattering_loses():
    """A white metal of roughness 1 loses ln 2 of the light from above; with either way nothing, to the table's 1e-2."""
    assert albedo(model_of("cook_torrance"), 1.0, 1.0) == pytest.approx(1 - np.log(2), abs=1e-3)
    for kind in ("turquin", "kulla_conty"):
        for cosine in (1.0, 0.5, 0.2):
            assert albedo(model_of("cook_torrance", compensation=kind), cosine, 1.0) == pytest.approx(1, abs=0.01)
