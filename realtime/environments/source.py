"""The environment as a cube with mip levels: what lobes are filtered from."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from lightmeter.scenes.model import Environment

from ..device import Device
from ..environment_map import EnvironmentMap
from .cube_atlas import bake_atlas, faces_of

SMALLEST, LARGEST = 16, 1024
"""Texels along a face, at least and at most."""

FOOTPRINT = """#include "environment_map.glsl"
// The mean over the texel: a sun between two of its points would be lost.
vec3 baked(vec3 direction, int level) {
    int face = cube_face(direction);
    vec2 centre = on_face(direction, face);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < POINTS * POINTS; ++i) {
        vec2 step = (vec2(i % POINTS, i / POINTS) + 0.5) / float(POINTS) - 0.5;
        sum += environment_towards(normalize(through_face(centre + step * (2.0 / float(SIDE)), face)));
    }
    return sum / float(POINTS * POINTS);
}
"""


@dataclass(frozen=True, eq=False)
class EnvironmentSource:
    """A cube map of the environment, turned as the scene has it.

    Attributes:
        textures: by the sampler's name.
        uniforms: what `environment_filter.glsl` is told.
    """

    textures: dict[str, Any]
    uniforms: dict[str, Any]


def environment_source(device: Device, environment: Environment) -> EnvironmentSource:
    """As fine as the map, whose rows are 180° where a face's are 90°, up to `LARGEST`."""
    assert environment.map is not None, "a constant environment is not filtered"
    height = len(environment.map.texels)
    side = int(np.clip(1 << (height // 2 - 1).bit_length() if height > 2 else 1, SMALLEST, LARGEST))
    points = 2 * -(-height // (2 * side))
    atlas = bake_atlas(
        device,
        side,
        1,
        FOOTPRINT,
        {"POINTS": points},
        map_uniforms(environment),
        EnvironmentMap(device, environment).textures,
    )
    cube = device.cube(faces_of(device, atlas, side))
    return EnvironmentSource({"environment_source": cube}, {"source_texel": 4 * np.pi / (6 * side**2)})


def map_uniforms(environment: Environment) -> dict[str, Any]:
    """What `environment_map.glsl` is told."""
    return {"environment_radiance": np.array(environment.radiance), "environment_rotation": environment.rotation}
