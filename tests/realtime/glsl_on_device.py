"""Evaluates a GLSL function on the device over many inputs, and finds the functions that a file defines."""

import re
from pathlib import Path

import numpy as np

from lightmeter.realtime.device import Device
from lightmeter.realtime.shaders import SHARED, source
from lightmeter.realtime.twin import Twin
from lightmeter.realtime.uniforms import set_uniforms

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


def evaluate(device: Device, twin: Twin, folder: Path, inputs: list[np.ndarray], text: str | None = None):
    """The function over lanes: [result, out arguments…], each (components, n) float64.

    Args:
        inputs: an (components, n) array per argument that is not `out`.
        text: in place of the file's own, for planting mistakes.
    """
    n = inputs[0].shape[1]
    rows = -(-n // WIDTH)
    size = WIDTH, rows
    textures, reads = {}, []
    given = iter(inputs)
    for argument in twin.arguments:
        if argument.out:
            reads.append(f"    {argument.type} {argument.name}_;")
            continue
        values = np.zeros((16, rows * WIDTH), np.float32)
        values[: argument.size, :n] = next(given)
        parts = []
        for i in range(-(-argument.size // 4)):
            name = f"in_{argument.name}_{i}"
            data = np.ascontiguousarray(values[4 * i : 4 * i + 4].T)
            textures[name] = device.gl.texture(size, 4, data.tobytes(), dtype="f4")
            parts.append(f"texelFetch({name}, place, 0)")
        value = ", ".join(parts) if argument.type == "mat4" else f"{parts[0]}.{'xyzw'[: argument.size]}"
        reads.append(f"    {argument.type} {argument.name}_ = {argument.type}({value});")
    outs = [argument for argument in twin.arguments if argument.out]
    call = f"{twin.function}({', '.join(f'{a.name}_' for a in twin.arguments)})"
    lines = [
        '#include "surface.glsl"',
        text_of(twin, folder) if text is None else text,
        *(f"uniform sampler2D {name};" for name in textures),
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
    program = device.program(source("\n".join(lines), twin.defines, folder))
    targets = [device.target(size) for _ in range(1 + len(outs))]
    device.framebuffer(targets).use()
    device.gl.enable_only(device.gl.NOTHING)
    for unit, (name, texture) in enumerate(textures.items()):
        if name in program:
            texture.use(unit)
            program[name].value = unit
    set_uniforms(program, dict(twin.uniforms))
    device.draw(device.fullscreen(program), 3)
    widths = [{"vec2": 2, "vec3": 3, "vec4": 4}.get(t, 1) for t in (twin.result, *(a.type for a in outs))]
    results = []
    for target, width in zip(targets, widths, strict=True):
        flat = np.frombuffer(target.read(), np.float32).reshape(-1, 4)[:n, :width]
        results.append(flat.T.astype(np.float64))
    return results
