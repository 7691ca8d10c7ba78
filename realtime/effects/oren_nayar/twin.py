"""Float64 twins of oren_nayar.glsl: `scenes/optics/oren_nayar.py`, with the albedo's fit as the shader has it."""

from collections.abc import Callable
from functools import partial

import numpy as np

from lightmeter.scenes.optics import oren_nayar as optics

from ...effect import Knobs
from ...shared_twins import REFLECTED, above, color, cosine, towards, unit
from ...twin import Argument, Twin, uniform

FORMS = {
    "full": optics.full,
    "qualitative": optics.qualitative,
    "fujii": optics.fujii,
    "eon": partial(optics.eon, albedo=optics.fujii_albedo_fit),
}


def model(knobs: Knobs) -> Callable[..., np.ndarray]:
    """The effect under those knobs: f·(n·l), (3, N) in 1/sr, of base_color, metallic, roughness, specular, n, v, l."""
    form, spread = FORMS[str(knobs["form"])], float(knobs["spread"])

    def oren_nayar(base_color, _metallic, roughness, _specular, n, v, l):  # noqa: E741 (l: light)
        return form(base_color, roughness * spread, n, v, l)

    return oren_nayar


def lean(n, v, l):  # noqa: E741
    """sin θᵥ·sin θₗ·cos φ."""
    return np.sum(np.cross(n, v, axis=0) * np.cross(n, l, axis=0), axis=0)


FORM = {"FORM": "oren_nayar_eon"}


def form(name: str, roundings: float, why: str, cancels: float = 0.0) -> Twin:
    """The twin of a form."""
    return Twin(
        "oren_nayar.glsl",
        f"oren_nayar_{name}",
        "vec3",
        (color("rho"), unit("spread_of_slopes"), towards("n"), towards("v"), towards("l")),
        FORMS[name],
        roundings=roundings,
        why=why,
        arrange=above,
        cancels=cancels,
        defines=FORM,
        brdf=REFLECTED,
    )


def pair(name: str, low: float, high: float) -> Argument:
    """One number for v and one for l."""
    return Argument(name, "vec2", uniform(low, high, 2), ((low, low), (high, high), (low, high)))


TWINS = (
    Twin(
        "oren_nayar.glsl",
        "grooves",
        "vec3",
        (
            color("rho"),
            unit("sigma"),
            pair("angles", 0.0, 1.570796),
            pair("sines", 0.0, 1.0),
            pair("cosines", 1e-2, 1.0),
            Argument("cos_phi", "float", uniform(-1.0, 1.0), (-1.0, 1.0, 0.01)),
        ),
        optics.grooves,
        roundings=1 + 1 + 2.5 + 2 + 4 + 3 + 2.5 + 3 + 3,
        why="σ² and a sum, the division and two more; the angles' products (4), two tangents (a sum and a division) "
        "with theirs, the sums, ρ/π and ρ²",
        defines=FORM,
    ),
    Twin(
        "oren_nayar.glsl",
        "lean",
        "float",
        (towards("n"), towards("v"), towards("l")),
        lean,
        roundings=2 + 3,
        why="the cross products (2), which the scalar product multiplies, and that (3)",
        defines=FORM,
    ),
    Twin(
        "oren_nayar.glsl",
        "fujii_albedo",
        "float",
        (cosine("cosine"), unit("roughness")),
        optics.fujii_albedo_fit,
        roundings=1 + 7 + 2 + 1 + 3 + 2.5,
        why="1 − µ, the polynomial (7), numerator (2), the constant (3, folded) with its product and sum, the division",
        cancels=1.0,
        defines=FORM,
    ),
    form(
        "qualitative",
        roundings=1 + 1 + 2.5 + 2 + 5 + 3 + 2.5 + 2 + 4,
        why="σ² and a sum, the division, two more; lean (5) over a cosine (3) by division; the product and the sum; "
        "ρ/π and n·l",
    ),
    form(
        "fujii",
        roundings=5 + 3 + 2.5 + 2 + 3 + 1 + 2.5 + 4,
        why="lean (5) over a cosine (3) by division; the product and the sum; the constant (3), its sum and division; "
        "ρ/π and n·l",
        cancels=1 / np.pi,
    ),
    form(
        "eon",
        roundings=30 + 2 * 18 + 6,
        why="Fujii's form (30), two albedos (16.5 each and the difference from 1), the products",
        cancels=1 / np.pi,
    ),
    form(
        "full",
        roundings=4096 / 2 + 60,
        why="atan of two arguments may err by 4096 ulp (GLSL 4.60, 4.7.1; an ulp is at least ε/2); the rest as above",
    ),
)
