"""Sums over the sphere of what arrives, weighted with functions of the direction."""

from collections.abc import Sequence
from pathlib import Path

from lightmeter.scenes.model import Environment

from ..device import Device
from ..environment_map import EnvironmentMap
from ..shaders import source
from .fill import fill
from .source import map_uniforms

LEAST = 512, 256
"""Columns and rows, at least: a sum at their centres is off by some 1/rows² of a smooth function's integral."""


def moments(device: Device, environment: Environment, basis: str, weights: Sequence[float], folder: Path | None = None):
    """A texture of one row: weights[k] · ∫ L(ω)·basis(k, ω) dω in column k.

    Args:
        basis: GLSL with `float basis(int index, vec3 direction)`, or the file that has it.
        folder: the effect's, where the file may be.
    """
    assert environment.map is not None, "the integrals of a constant environment are known"
    height, width = environment.map.texels.shape[:2]
    # A whole number of points a texel, so that none is left out and none counts more.
    columns, rows = (n * -(-least // n) for n, least in zip((width, height), LEAST, strict=True))
    count = len(weights)
    included = f'#include "{basis}"' if basis.endswith(".glsl") else basis
    text = source("environment_rows.frag").text.removeprefix("#version 410\n").replace("BASIS", included)
    defines = {"ROWS": rows, "COLUMNS": columns, "COEFFICIENTS": count}
    by_row = fill(
        device,
        source(text, defines, folder),
        (count, rows),
        map_uniforms(environment),
        EnvironmentMap(device, environment).textures,
    )
    return fill(
        device, source("column_sums.frag", {"COUNT": count}), (count, 1), {"weights": list(weights)}, {"rows": by_row}
    )
