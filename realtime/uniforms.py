"""Values for shaders: converted once, written at every draw."""

from typing import Any

import numpy as np


class Uniforms:
    """Those of some values that a program really uses, as bytes.

    Args:
        values: by name. Matrices are (4, 4), or (n, 4, 4) for an array of them, as they are written on paper: column
            vectors. Text (a knob that is a choice) is for `#define`s and left out here.
    """

    def __init__(self, program: Any, values: dict[str, Any]) -> None:
        self._writes = [
            (program[name], _bytes(program[name], value))
            for name, value in values.items()
            if name in program and not isinstance(value, str)
        ]

    def write(self) -> None:
        """Hand the values to the program."""
        for member, data in self._writes:
            member.write(data)


def set_uniforms(program: Any, values: dict[str, Any]) -> None:
    """Set uniforms that change from draw to draw."""
    Uniforms(program, values).write()


def _bytes(member: Any, value: Any) -> bytes:
    array = np.asarray(value)
    if array.shape[-2:] == (4, 4):
        array = array.swapaxes(-1, -2)
    dtype = np.int32 if member.fmt.endswith("i") else np.float32
    return np.ascontiguousarray(array, dtype=dtype).tobytes()


def bind(program, textures: dict[str, Any]) -> None:
    """Bind those textures that the program samples; a list goes to an array of samplers."""
    unit = 0
    for name, bound in textures.items():
        if name not in program:
            continue
        several = bound if isinstance(bound, list) else [bound]
        for place, texture in enumerate(several, unit):
            texture.use(place)
        units = list(range(unit, unit + len(several)))
        program[name].value = units if len(units) > 1 else unit
        unit += len(units)
