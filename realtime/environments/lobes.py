"""Cubes of the environment as the material's lobes see it."""

from typing import Any

from ..device import Device
from .cube_atlas import bake_atlas
from .source import EnvironmentSource

DIFFUSE = """#include "environment_filter.glsl"
vec3 baked(vec3 direction, int level) { return diffuse_radiance(direction); }
"""

SPECULAR = """#include "environment_filter.glsl"
// Roughness grows evenly from level to level.
vec3 baked(vec3 direction, int level) {
    float roughness = float(level) / float(LEVELS - 1);
    return specular_radiance(direction, max(roughness * roughness, MIN_ALPHA));
}
"""


def diffuse_cube(device: Device, source: EnvironmentSource, side: int, samples: int, filtered: bool) -> Any:
    """Irradiance over π, in an atlas of one level."""
    defines = {"SAMPLES": samples, "FILTERED": filtered}
    return bake_atlas(device, side, 1, DIFFUSE, defines, source.uniforms, source.textures)


def specular_cube(
    device: Device, source: EnvironmentSource, side: int, levels: int, samples: int, filtered: bool
) -> Any:
    """The mean radiance under GGX's lobe, roughness 0…1 over the levels of an atlas."""
    defines = {"SAMPLES": samples, "FILTERED": filtered, "LEVELS": levels}
    return bake_atlas(device, side, levels, SPECULAR, defines, source.uniforms, source.textures)
