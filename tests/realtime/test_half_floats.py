"""Shading functions with every operation rounded to half floats, against NumPy's float16, operation by operation.

NumPy reckons each operation of float16 in float32 and rounds. That is the correctly rounded result: float32 has more
than twice a half float's bits and two (Figueroa 1995, "When is double rounding innocuous?"), for + − × ÷ and √.
"""

from collections.abc import Callable
from functools import partial

import numpy as np
import pytest

from lightmeter.realtime.device import DeviceError
from lightmeter.realtime.glsl_on_device import FunctionOnDevice
from lightmeter.realtime.stress.every_operation import RewritingError, hold_operations
from lightmeter.realtime.stress.half_floats import FunctionInHalfFloats, with_held_operations
from lightmeter.realtime.stress.naming import named, subjects
from lightmeter.realtime.twin import SIZES, Argument, Twin, uniform

LANES = 1 << 15
HALF = np.float16
WHOLE = np.arange(1 << 16, dtype=np.uint16).view(HALF)
"""Every half float there is."""


@pytest.fixture(autouse=True)
def quiet():
    """Overflow and NaN are what is looked for."""
    with np.errstate(all="ignore"):
        yield


def planted(device, tmp_path, glsl: str, *arguments: Argument, result: str = "float", **given) -> FunctionInHalfFloats:
    (tmp_path / "planted.glsl").write_text(glsl)
    twin = Twin("planted.glsl", "planted", result, arguments, lambda *x: x, 1, "")
    return FunctionInHalfFloats(device, twin, tmp_path, **given)


def number(name: str, kind: str = "float") -> Argument:
    return Argument(name, kind, uniform(0, 1, SIZES[kind]))


def same(got: np.ndarray, want: np.ndarray) -> np.ndarray:
    """Where two arrays hold the same, NaN and the sign of 0 included."""
    return (got == want) & (np.signbit(got) == np.signbit(want)) | (np.isnan(got) & np.isnan(want))


def test_held_is_the_nearest_half_float(device, tmp_path):
    """Of every half float, the middles between, and any bits."""
    rng = np.random.default_rng(0)
    middles = (WHOLE[:-1].astype(np.float64) + WHOLE[1:]) / 2
    anything = rng.integers(0, 1 << 32, 1 << 18, dtype=np.uint64).astype(np.uint32).view(np.float32)
    x = np.concatenate([WHOLE, middles, anything, [65519.99, 65520, -65520]]).astype(np.float32)
    (tmp_path / "planted.glsl").write_text("float planted(float x) { return x * 1.0; }")
    twin = Twin("planted.glsl", "planted", "float", (number("x"),), lambda x: x, 1, "")
    rewrite = partial(with_held_operations, function="planted", defines=["HALF"])
    got = FunctionOnDevice(device, twin, tmp_path, rewrite=rewrite)([x[None].astype(np.float64)])[0][0]
    assert same(got, x.astype(HALF)).all()


def test_flushed_denormals_are_0(device, tmp_path):
    glsl = "float planted(vec2 x) { return x.x * x.y; }"
    function = planted(device, tmp_path, glsl, number("x", "vec2"), flush=True)
    least = 2.0**-14
    inputs = np.array([[least, 1.0], [least, 0.999], [2 * least, 0.5], [least / 2, 4.0], [-least, 0.5]]).T
    assert function([inputs])[0][0].tolist() == [least, 0, least, 0, 0]


def d_ggx(n_dot_h, sin2_h, alpha):
    k = alpha / (n_dot_h * n_dot_h * alpha * alpha + sin2_h)
    return np.where(n_dot_h <= 0, HALF(0), k * k * (HALF(1) / HALF(np.pi)))


def v_smith_ggx_correlated(v, l, alpha):  # noqa: E741
    a2 = alpha * alpha
    lambda_v = l * np.sqrt(v * v * (HALF(1) - a2) + a2)
    lambda_l = v * np.sqrt(l * l * (HALF(1) - a2) + a2)
    return HALF(0.5) / np.maximum(lambda_v + lambda_l, HALF(1e-30))


def f_schlick(v_dot_h, f0, f90):
    m = np.clip(HALF(1) - v_dot_h, HALF(0), HALF(1))
    m2 = m * m
    return f0 + (f90 - f0) * (m2 * m2 * m)


def reflectance_f0(base_color, metallic, specular):
    return HALF(0.04) * specular * (HALF(1) - metallic) + base_color * metallic


def spot_attenuation(cos_angle, cos_inner, cos_outer):
    width = np.maximum(HALF(1e-3), cos_inner - cos_outer)
    ramp = np.clip((cos_angle - cos_outer) / width, HALF(0), HALF(1))
    return ramp * ramp


def transformed(uv, row_u, row_v):
    return np.stack([uv[0] * row[0] + uv[1] * row[1] + row[2] for row in (row_u, row_v)])


def from_bytes(codes):
    return codes[0] * HALF(65536) + codes[1] * HALF(256) + codes[2]


@pytest.mark.parametrize(
    "python", [d_ggx, v_smith_ggx_correlated, f_schlick, reflectance_f0, spot_attenuation, transformed, from_bytes]
)
def test_a_function_is_what_numpys_float16_makes_of_it(device, python: Callable):
    (subject,) = named(f"shared/{python.__name__}", subjects())
    rng = np.random.default_rng(1)
    inputs = [np.reshape(a.draw(rng, LANES), (-1, LANES)) for a in subject.twin.arguments]
    got = FunctionInHalfFloats(device, subject.twin, subject.folder)(inputs)[0]
    halves = [x.astype(HALF) for x in inputs]
    want = python(*(x[0] if a.size == 1 else x for a, x in zip(subject.twin.arguments, halves, strict=True)))
    assert want.dtype == HALF
    assert np.isfinite(want).mean() > 0.2 or python is from_bytes
    assert same(got, want).all()


FORMS = """
#define WIDENED (x * 3.0)
#define COUNT 3
const float PI = 3.14159265;
const float SHARE = 1.0 / PI;
const vec2 PLACES[2] = vec2[2](vec2(0.1, 0.2), vec2(0.3));
float doubled(float x, out float more) {
    more = x + 0.1;
    return 2.0 * x;
}
float planted(float x, float y) {
    const int n = COUNT * 1000 + 1;
    float sums[COUNT + 1];
    int i = 2 * n - 1;
    for (int k = 0; k < COUNT; k++) sums[k] = x + float(k);
    sums[COUNT] = x;
    sums[1] *= y + 0.7;
    sums[1] -= y - 0.3;
    x /= y > 0.5 ? 3.0 : 7.0;
    float more = 0.0;
    float twice = doubled(-x, more);
    vec2 place = PLACES[1];
    place.xy += PLACES[0] * y;
    float index = float(min(i, 6001)) / (10.0 + 0.3 * WIDENED);
    return SHARE * sums[1] + index + twice * more - (place.x - place.y * y) + sums[COUNT];
}
"""


def forms(x, y):
    def h(value: float) -> np.float16:
        return HALF(value)

    sum_1 = (x + h(1)) * (y + h(0.7))
    sum_1 = sum_1 - (y - h(0.3))
    first = x
    x = x / np.where(y > 0.5, h(3), h(7))
    twice, more = h(2) * -x, -x + h(0.1)
    place = h(0.3) + h(0.1) * y, h(0.3) + h(0.2) * y
    share, index = h(1) / h(np.pi), h(2 * 3001 - 1)
    return share * sum_1 + index / (h(10) + h(0.3) * (x * h(3))) + twice * more - (place[0] - place[1] * y) + first


def test_every_form_of_expression_is_rounded(device, tmp_path):
    rng = np.random.default_rng(2)
    x, y = rng.uniform(0.1, 2, (2, LANES)).astype(HALF)
    function = planted(device, tmp_path, FORMS, number("x"), number("y"))
    got = function([x[None].astype(np.float64), y[None].astype(np.float64)])[0][0]
    assert same(got, forms(x, y)).all()


def test_geometry_is_rounded_step_by_step(device, tmp_path):
    glsl = """vec4 planted(vec3 a, vec3 b) {
        mat3 m = mat3(a, b, a);
        vec3 turned = m * b;
        return vec4(dot(a, b), mix(a.x, a.y, b.z), cross(a, b).y, turned.z);
    }"""
    rng = np.random.default_rng(3)
    a, b = rng.uniform(-1, 1, (2, 3, LANES)).astype(HALF)
    function = planted(device, tmp_path, glsl, number("a", "vec3"), number("b", "vec3"), result="vec4")
    got = function([a.astype(np.float64), b.astype(np.float64)])[0]
    want = [
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2],
        a[0] * (HALF(1) - b[2]) + a[1] * b[2],
        a[2] * b[0] - a[0] * b[2],
        a[2] * b[0] + b[2] * b[1] + a[2] * b[2],
    ]
    assert same(got, np.array(want)).all()
    glsl = "vec3 planted(vec3 a) { return normalize(a) * length(a); }"
    got = planted(device, tmp_path, glsl, number("a", "vec3"), result="vec3")([1e3 * a.astype(np.float64)])[0]
    long = np.abs(1e3 * a.astype(np.float64)).max(axis=0) > 256  # 256² leaves a half float's range
    assert long.any() and not np.isfinite(got[:, long]).any()


def test_what_is_not_known_does_not_compile(device, tmp_path):
    with pytest.raises(DeviceError, match="held_packUnorm2x16"):
        planted(device, tmp_path, "float planted(vec2 x) { return float(packUnorm2x16(x)); }", number("x", "vec2"))
    with pytest.raises(RewritingError, match=r"line 2 of a shader .*: 'return x \+ ;'"):
        hold_operations("float planted(float x) {\n    return x + ;\n}\n", "planted")


def test_only_what_a_function_needs_is_written():
    text = "float a(float x) { return x; }\nfloat b(float x) { return a(x); }\nfloat c(float x) { return b(x); }\n"
    assert "float a" in hold_operations(text, "b") and "float c" not in hold_operations(text, "b")
