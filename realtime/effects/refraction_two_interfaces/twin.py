"""Float64 twin of what leaves a solid."""

import numpy as np

from lightmeter.scenes.optics import dielectric

from ...twin import Argument, Twin, direction, uniform


def leaving(outward: np.ndarray, inside: np.ndarray, ior: np.ndarray) -> np.ndarray:
    """Snell's law, or along the surface from the critical angle on; unit."""
    cosine = np.clip(np.sum(outward * inside, axis=0), 0.0, 1.0)
    found = dielectric.refracted(-outward, -inside, cosine, 1 / ior)
    return found / np.linalg.norm(found, axis=0)


def _critical(outward, inside, ior):
    """How far from the critical angle, and from where the cosine is clamped."""
    cosine = np.sum(outward * inside, axis=0)
    return [(1 - (1 - cosine**2) * ior[0] ** 2, 1 + 3 * ior[0] ** 2), (cosine, 3 + 0 * cosine)]


TWINS = (
    Twin(
        "refraction_two_interfaces.glsl",
        "leaving",
        "vec3",
        (
            Argument("outward", "vec3", direction),
            Argument("inside", "vec3", direction),
            Argument("ior", "float", uniform(1.05, 3.0), (1.5,)),
        ),
        leaving,
        cancels=1.0,
        signs=_critical,
        guards=("1.0",),
        defines={"LAYER_GLASS": True},
        roundings=5 + 2.5 + 16 + 6,
        why="the scalar product (5), the reciprocal (2.5), the refracted direction (16), its normalisation (6)",
    ),
)
