"""Every shading function in GLSL against its float64 twin, with a tolerance derived from float32.

A result f(x) that is computed with k roundings, each of relative size ε = 2⁻²³ at most, is the exact result for
inputs moved by k·ε relatively, moved once more itself: |error| ≤ k·ε·(|f| + Σ |xᵢ|·|∂f/∂xᵢ|) to first order. For a
vector the norm stands in place of |xᵢ|, since sums and products of its components carry errors of the longest one's
size. k is counted per function in its declaration; derivatives are finite differences in float64.

Where a branch depends on the sign of a computed sum of n products, float32 knows it only beyond n·ε·Σ|terms|. In
those lanes either branch is right; the result must be finite, and not negative.
"""

import re
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from lightmeter.realtime.declared_twins import declared_twins
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.glsl_on_device import evaluate, functions, text_of
from lightmeter.realtime.shaders import SHARED
from lightmeter.realtime.stress.half_floats import with_held_operations
from lightmeter.realtime.twin import Twin
from lightmeter.scenes.terms import TERMS

EPS = float(np.finfo(np.float32).eps)
LANES = 6144
STEP = 1e-6  # of the finite differences: relative; float64 leaves 1e-10 of the derivative

NOT_TWINNED = {
    "ltc_area_light.glsl": {"cut_side", "add_side"},  # hand structures on: test_ltc.py
    "split_sum.glsl": {"irradiance", "under_lobe"},  # look up: test_environments.py, test_layers_under_maps.py
    "surface.glsl": {"load_surface"},  # fetches the G-buffer
    "stored.glsl": {  # packing.glsl's functions in the formats that are chosen: test_gbuffer_formats.py
        "depth_of",
        "at_depth",
        "pack_depth",
        "unpack_depth",
        "normal_codes",
        "from_normal_codes",
        "pack_normal",
        "unpack_normal",
    },
    "constant_ambient.glsl": {"surface_albedo"},  # hands the surface on: test_material_layers.py
    "punctual.glsl": {"received_at"},  # reads the light: test_direct_control.py
    "compensation.glsl": {"single_scattering_albedo", "uncompensated", "turquin", "kulla_conty"},  # read the table, or
    # choose whether to: test_shading_models.py
    "received.glsl": {"all_lobes", "diffuse_only"},  # the surface handed on: test_virtual_lights.py
    "shadow_views.glsl": {"from_light", "view_of", "receive"},  # uniforms handed on: test_shadow_maps.py
    "reflections.glsl": {"reflected"},  # asks the technique, whose seen_along reads pictures: test_reflections.py
    "static_cube_map.glsl": {"seen_along"},
    "local_cube_map.glsl": {"seen_along"},
    "dynamic_cube_map.glsl": {"seen_along"},
    "screen_space_reflections.glsl": {"unmet", "seen_along"},
    "marching.glsl": {"ray_depth", "unmet_verdict"},  # take a structure: test_reflections.py
    "hemisphere.glsl": {"occlusion"},  # reads the screen by shown.glsl: test_ambient_visibility.py
    "horizons.glsl": {"horizon_towards", "occlusion"},  # likewise
    "occluded_ambient.glsl": {"occluded_ambient"},  # hands the surface on: test_ambient_visibility.py
    "cube_maps.glsl": {"place_in_cube"},  # uniforms handed on: test_reflections.py
    "solid_front.glsl": {"entering", "behind_front"},  # take a structure: test_refraction.py
    "seen_around.glsl": {"seen_around", "seen_behind"},  # looks up: test_refraction.py
    "refraction_bounces.glsl": {"from_within"},  # follows a ray through textures: test_refraction.py
    "shadow_keep.glsl": {"keep"},  # derivatives: test_filtered_shadows.py
}
"""Plumbing; what reads a texture, or calls what does, is told by its text."""

TWINS = declared_twins()
NAMES = [f"{twin.file}-{twin.function}" for _, twin in TWINS]


def inputs_of(twin: Twin, seed: int = 1) -> list[np.ndarray]:
    """(components, n) float32 values in float64: random ones, a third of the lanes mixed with boundary values."""
    rng = np.random.default_rng(seed)
    drawn = []
    for argument in twin.arguments:
        if not argument.out:
            assert argument.draw is not None
            drawn.append(argument.draw(rng, LANES))
    arguments = [argument for argument in twin.arguments if not argument.out]
    mixed = rng.random(LANES) < 1 / 3
    for index, argument in enumerate(arguments):
        if len(argument.boundary):
            boundary = np.array(argument.boundary, dtype=np.float64).T
            picked = boundary[..., rng.integers(0, boundary.shape[-1], LANES)]
            drawn[index] = np.where(mixed & (rng.random(LANES) < 0.5), picked, drawn[index])
    if twin.arrange:
        drawn = twin.arrange(rng, drawn)
    return [np.reshape(values, (-1, LANES)).astype(np.float32).astype(np.float64) for values in drawn]


def exact(twin: Twin, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """The twin's [result, out arguments…], each (components, n)."""
    arguments = [argument for argument in twin.arguments if not argument.out]
    given = [values[0] if a.size == 1 else values for a, values in zip(arguments, inputs, strict=True)]
    result = twin.python(*given)
    results = result if isinstance(result, tuple) else (result,)
    return [np.broadcast_to(np.asarray(r, np.float64), (*np.shape(r)[:-1], LANES)).reshape(-1, LANES) for r in results]


def tolerance(twin: Twin, inputs: list[np.ndarray], values: list[np.ndarray]) -> list[np.ndarray]:
    """k·ε·(|f| + Σ |x|·|∂f/∂xᵢ|) for each result; of the two one-sided derivatives the larger."""
    reach = [np.abs(value) + twin.cancels for value in values]
    arguments = [argument for argument in twin.arguments if not argument.out]
    for index, argument in enumerate(arguments):
        if not argument.continuous:
            continue
        norm = np.linalg.norm(inputs[index], axis=0)
        step = STEP * np.maximum(norm, 1e-30)
        for component in range(argument.size):
            largest = [np.zeros_like(value) for value in values]
            for sign in (1, -1):
                moved = [value.copy() for value in inputs]
                moved[index][component] += sign * step
                for slot, (there, here) in enumerate(zip(exact(twin, moved), values, strict=True)):
                    with np.errstate(invalid="ignore", over="ignore"):
                        largest[slot] = np.fmax(largest[slot], np.abs(there - here) / step * norm)
            for slot, change in enumerate(largest):
                reach[slot] = reach[slot] + change
    # The smallest normal float32 is a floor: below it digits are lost or flushed.
    return [twin.roundings * EPS * r + 1.2e-38 for r in reach]


def undecided(twin: Twin, inputs: list[np.ndarray]) -> np.ndarray:
    """(n,) lanes where float32 cannot tell the sign that a branch depends on."""
    lanes = np.zeros(LANES, bool)
    if twin.signs:
        for value, magnitude in twin.signs(*inputs):
            lanes |= np.abs(value) <= 4 * EPS * magnitude
    return lanes


EXPECTED: dict[int, tuple] = {}


def expected(twin: Twin) -> tuple[list, list, list, np.ndarray]:
    """Inputs, exact values, what they may err by, undecided lanes: found once a twin, since the derivatives cost."""
    if id(twin) not in EXPECTED:
        inputs = inputs_of(twin)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            values = exact(twin, inputs)
            allowed = tolerance(twin, inputs, values)
        EXPECTED[id(twin)] = inputs, values, allowed, undecided(twin, inputs)
    return EXPECTED[id(twin)]


def worst(device, twin: Twin, folder: Path, text: str | None = None, **given) -> float:
    """The largest error as a share of the tolerance; infinite where something is not finite."""
    inputs, values, allowed, unclear = expected(twin)
    share = 0.0
    got = evaluate(device, twin, folder, inputs, text, **given)
    for slot, (g, value, limit) in enumerate(zip(got, values, allowed, strict=True)):
        assert np.isfinite(value).all() and np.isfinite(limit).all(), f"the twin of {twin.function} is not finite"
        if not np.isfinite(g).all() or (slot == 0 and (g[:, unclear] < 0).any()):
            return np.inf
        error = np.abs(g - value)[:, ~unclear]
        share = max(share, float((error / limit[:, ~unclear]).max()))
    return share


@pytest.mark.parametrize(("folder", "twin"), TWINS, ids=NAMES)
def test_glsl_meets_its_twin(device, folder, twin, record_property):
    share = worst(device, twin, folder)
    record_property("share_of_the_tolerance", share)
    assert share <= 1, f"{twin.function} errs by {share:.2f} of {twin.roundings} roundings ({twin.why})"


@pytest.mark.parametrize(("folder", "twin"), TWINS, ids=NAMES)
def test_it_still_does_with_every_operation_held(device, folder, twin):
    """Written again so that each operation can be rounded, and rounded not at all, a function means what it meant.

    Not to the last bit: a compiler knows x·(1 − a) + y·a, and has an order of its own for the steps of dot or reflect.
    """
    share = worst(device, twin, folder, rewrite=partial(with_held_operations, function=twin.function))
    assert share <= 1, f"{twin.function} errs by {share:.2f} of {twin.roundings} roundings ({twin.why})"


@pytest.mark.parametrize(("folder", "twin"), TWINS, ids=NAMES)
def test_enough_lanes_are_decided(folder, twin):
    assert expected(twin)[-1].mean() < 0.05


def changed_constants(definition: str) -> list[tuple[str, str]]:
    """The definition with one number changed by a hundredth, for each number in it that is not a guard."""
    found = []
    code = re.sub(r"//.*", lambda comment: " " * len(comment[0]), definition)
    for match in re.finditer(r"(?<![\w.])(\d+\.\d*(?:e[+-]?\d+)?|\d+e[+-]?\d+)", code):
        value = float(match[0])
        if (value != 0 and value < 1e-6) or value == 0:
            continue  # a guard against division by zero, or a comparison with zero
        changed = f"{value * 1.01:.9g}"
        changed += "" if "." in changed or "e" in changed else ".0"
        found.append((match[0], definition[: match.start()] + changed + definition[match.end() :]))
    return found


@pytest.mark.parametrize(("folder", "twin"), TWINS, ids=NAMES)
def test_a_changed_constant_is_noticed(device, folder, twin):
    """The test can fail: one number in the function, a hundredth off, and the twin disagrees."""
    text = text_of(twin, folder)
    definition = functions(text)[twin.function]
    for number, changed in changed_constants(definition):
        if number in twin.guards:
            continue
        share = worst(device, twin, folder, text.replace(definition, changed))
        assert share > 1, f"{number} in {twin.function} may change unnoticed"


LOOK_UPS = "texelFetch", "texture", "textureLod", "textureSize", "fetch_place"


def readers(definitions: dict[str, str]) -> set[str]:
    """The functions that read a texture, by themselves or by calling one of these that does."""
    found: set[str] = set()
    while True:
        calls = "|".join((*LOOK_UPS, *found))
        more = {n for n, text in definitions.items() if re.search(rf"\b(?:{calls})\(", text.partition("{")[2])}
        if more == found:
            return found
        found = more


def test_every_function_has_a_twin():
    folders = {"shared": SHARED} | {name: effect.folder for name, effect in effects().items()}
    held = {(twin.file, twin.function) for _, twin in TWINS}
    missing = []
    for owner, folder in folders.items():
        for path in sorted(folder.glob("*.glsl")):
            terms = set(effects()[owner].terms) if owner in effects() else set()
            definitions = functions(path.read_text(encoding="utf-8"))
            plumbing = NOT_TWINNED.get(path.name, set()) | readers(definitions)
            for name in definitions:
                if name not in plumbing and name not in terms & set(TERMS) and (path.name, name) not in held:
                    missing.append(f"{path.name}: {name}")
    assert not missing


def test_twins_name_functions_that_exist():
    for folder, twin in TWINS:
        assert twin.function in functions(text_of(twin, folder)), twin
