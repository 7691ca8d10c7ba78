"""Evaluates a GLSL function on the device over many inputs, and finds the functions that a file defines."""

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np

from .device import Device
from .shaders import SHARED, Source, source
from .twin import Argument, Twin
from .uniforms import bind, set_uniforms

WIDTH = 1024
FUNCTION = re.compile(r"^(?:void|float|int|bool|vec[234]|mat[234])\s+(\w+)\s*\(([^)]*)\)\s*\{", re.MULTILINE)


def text_of(twin: Twin, folder: Path) -> str:
    """The file that defines the twin's function."""
    place = folder / twin.file
    return (place if place.is_file() else SHARED / twin.file).read_text(encoding="utf-8")


def functions(text: str) -> dict[str, str]:
    """The functions a file defines: name to the whole definition."""
    found = {}
    for match in FUNCTION.finditer(text):
        depth, end = 1, match.end()
        while depth:
            depth += {"{": 1, "}": -1}.get(text[end], 0)
            end += 1
        found[match[1]] = text[match.start() : end]
    return found


FORMATS = {"f4": (4, "f4", None), "f2": (4, "f2", None), "r11g11b10f": (3, "f2", 0x8C3A)}
"""Targets: components, moderngl's type, and GL's internal format where it is not that type's own."""


class FunctionOnDevice:
    """A GLSL function as a compiled full-screen pass, called as often as is wanted.

    Args:
        folder: where the twin's file lies, or an effect's folder beside the shared shaders.
        text: in place of the file's own, for planting mistakes.
        rewrite: makes of the shader with the function, whole and with what it includes, another one.

    Raises:
        DeviceError: the file does not compile.
    """

    def __init__(
        self,
        device: Device,
        twin: Twin,
        folder: Path,
        text: str | None = None,
        rewrite: Callable[[str], str] = lambda text: text,
    ) -> None:
        self._device, self._arguments = device, [a for a in twin.arguments if not a.out]
        self._outs = [a for a in twin.arguments if a.out]
        self._widths = [WIDTHS.get(t, 1) for t in (twin.result, *(a.type for a in self._outs))]
        body = '#include "surface.glsl"\n' + (text_of(twin, folder) if text is None else text)
        functions = rewrite(source(body, twin.defines, folder).text)
        self._program = device.program(Source(functions + _main(twin)))
        self._vertices = device.fullscreen(self._program)
        self._uniforms = dict(twin.uniforms)

    def __call__(self, inputs: list[np.ndarray], target: str = "f4") -> list[np.ndarray]:
        """The function over lanes: [result, out arguments…], each (components, n) float64.

        Args:
            inputs: an (components, n) array per argument that is not `out`.
            target: what the results are written to, of FORMATS.
        """
        gl, n = self._device.gl, inputs[0].shape[1]
        rows = -(-n // WIDTH)
        size = WIDTH, rows
        textures = {}
        for argument, given in zip(self._arguments, inputs, strict=True):
            values = np.zeros((16, rows * WIDTH), np.float32)
            values[: argument.size, :n] = given
            for i, name in enumerate(_samplers(argument)):
                data = np.ascontiguousarray(values[4 * i : 4 * i + 4].T)
                textures[name] = gl.texture(size, 4, data.tobytes(), dtype="f4")
        components, dtype, internal = FORMATS[target]
        extra = {} if internal is None else {"internal_format": internal}
        targets = [gl.texture(size, components, dtype=dtype, **extra) for _ in self._widths]
        self._device.framebuffer(targets).use()
        gl.enable_only(gl.NOTHING)
        bind(self._program, textures)
        set_uniforms(self._program, self._uniforms)
        self._device.draw(self._vertices, 3)
        results = []
        for drawn, width in zip(targets, self._widths, strict=True):
            flat = np.frombuffer(drawn.read(alignment=1), np.float32 if dtype == "f4" else np.float16)
            results.append(flat.reshape(-1, components)[:n, :width].T.astype(np.float64))
        return results


WIDTHS = {"vec2": 2, "vec3": 3, "vec4": 4}


def evaluate(device: Device, twin: Twin, folder: Path, inputs: list[np.ndarray], text: str | None = None, **given):
    """The function over lanes, once; see `FunctionOnDevice`."""
    return FunctionOnDevice(device, twin, folder, text, **given)(inputs)


def _samplers(argument: Argument) -> list[str]:
    """The textures that hold an argument, four components each."""
    return [f"in_{argument.name}_{i}" for i in range(-(-argument.size // 4))]


def _main(twin: Twin) -> str:
    """A fragment shader's end, which reads the arguments, calls the function and writes what it gives."""
    samplers, reads = [], []
    for argument in twin.arguments:
        if argument.out:
            reads.append(f"    {argument.type} {argument.name}_;")
            continue
        names = _samplers(argument)
        samplers += names
        parts = [f"texelFetch({name}, place, 0)" for name in names]
        value = ", ".join(parts) if argument.type == "mat4" else f"{parts[0]}.{'xyzw'[: argument.size]}"
        reads.append(f"    {argument.type} {argument.name}_ = {argument.type}({value});")
    outs = [argument for argument in twin.arguments if argument.out]
    call = f"{twin.function}({', '.join(f'{a.name}_' for a in twin.arguments)})"
    return "\n".join(
        [
            "",
            *(f"uniform sampler2D {name};" for name in samplers),
            *(f"layout(location = {i}) out vec4 out_{i};" for i in range(1 + len(outs))),
            "vec4 wide(float x) { return vec4(x); }",
            "vec4 wide(int x) { return vec4(x); }",
            "vec4 wide(bool x) { return vec4(x); }",
            "vec4 wide(vec2 x) { return vec4(x, 0.0, 0.0); }",
            "vec4 wide(vec3 x) { return vec4(x, 0.0); }",
            "vec4 wide(vec4 x) { return x; }",
            "void main() {",
            "    ivec2 place = ivec2(gl_FragCoord.xy);",
            *reads,
            f"    out_0 = wide({call});",
            *(f"    out_{i + 1} = wide({argument.name}_);" for i, argument in enumerate(outs)),
            "}",
        ]
    )
