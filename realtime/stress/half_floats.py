"""Shading functions with every operation rounded to half floats, as a mobile GPU's `mediump` may round it.

The shader is parsed and written again with `held(…)` around each operation, as ANGLE does for
WEBGL_debug_shader_precision. Rounded once are + − × ÷ of numbers and of components, built-in functions that are no
formula (√, exp, log, sin, atan …), what a texture gives, and literals. What GLSL defines by a formula is rounded at
every step of it: dot, length, distance, normalize, cross, reflect, refract, mix, mod, smoothstep, products of
matrices, and pow = exp2(y·log2(x)); their precision is their formula's (OpenGL Shading Language 4.60, section 4.7.1).
Whole numbers stay exact.

A half float here is IEEE 754's binary16, to nearest, with its denormals, and infinite beyond 65,504. GLSL ES asks less
of mediump: denormals may be 0 (`flush`), and what overflows may stay at the largest number.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import cache, partial
from pathlib import Path

import numpy as np

from ..device import Device
from ..glsl_on_device import FunctionOnDevice
from ..twin import Twin
from .every_operation import hold_operations
from .judging import HALF_NORMAL


class FunctionInHalfFloats:
    """A GLSL function on the device; inputs, uniforms and every operation are rounded to half floats.

    Args:
        flush: denormal half floats become 0.

    Raises:
        RewritingError: the shader's text was not understood.
        DeviceError: what comes of it does not compile, as where a built-in function is called that is not known here.
    """

    def __init__(self, device: Device, twin: Twin, folder: Path, flush: bool = False) -> None:
        self._flush = flush
        self._continuous = [argument.continuous for argument in twin.arguments if not argument.out]
        uniforms = {name: self._held(np.asarray(value, np.float64)) for name, value in twin.uniforms.items()}
        rounded = replace(twin, uniforms=uniforms)
        defines = ["HALF", "FLUSH"] if flush else ["HALF"]
        rewrite = partial(with_held_operations, function=twin.function, defines=defines)
        self._function = FunctionOnDevice(device, rounded, folder, rewrite=rewrite)

    def __call__(self, inputs: list[np.ndarray]) -> list[np.ndarray]:
        """As `FunctionOnDevice`: [result, out arguments…] over lanes, float32 targets."""
        held = [self._held(x) if numbers else x for x, numbers in zip(inputs, self._continuous, strict=True)]
        return self._function(held)

    def _held(self, x: np.ndarray) -> np.ndarray:
        with np.errstate(over="ignore"):
            rounded = x.astype(np.float16).astype(np.float64)
        return np.where(np.abs(x) < HALF_NORMAL, 0, rounded) if self._flush else rounded


def with_held_operations(text: str, function: str, defines: Sequence[str] = ()) -> str:
    """A shader (`#version` first) in which every operation of a function goes through `held`.

    Args:
        defines: HALF rounds to half floats, FLUSH makes their denormals 0; without them `held` gives what it is given.
    """
    version, _, body = hold_operations(text, function).partition("\n")
    return "\n".join([version, *(f"#define {name}" for name in defines), _prelude(), body])


@cache
def _prelude() -> str:
    """`held`, and the functions that stand in place of built-in ones, for every type."""
    held, components, vectors, cross, matrices = (
        (Path(__file__).parent / "held" / f"{name}.glsl").read_text(encoding="utf-8")
        for name in ("held", "components", "vectors", "cross", "matrices")
    )
    sizes = "234"
    parts = [held, components.replace("genType", "float").replace("genBType", "bool")]
    parts += [components.replace("genType", f"vec{n}").replace("genBType", f"bvec{n}") for n in sizes]
    for text in (vectors, matrices):
        parts += [text.replace("vecN", f"vec{n}").replace("matN", f"mat{n}").replace("< N;", f"< {n};") for n in sizes]
    return "\n".join([*parts, cross])
