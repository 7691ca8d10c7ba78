"""Materials of dielectric solids."""

import math

from .model import Material, Vector


def glass(
    name: str, ior: float, attenuation_color: Vector = (1.0, 1.0, 1.0), attenuation_distance: float = 1.0
) -> Material:
    """The material of a smooth dielectric solid (KHR_materials_volume's parameters).

    Args:
        ior: index of refraction, above 1.
        attenuation_color: what the solid leaves of white light over the distance, above 0.
        attenuation_distance: metres; infinite: it absorbs nothing.
    """
    red, green, blue = (-math.log(share) / attenuation_distance for share in attenuation_color)
    return Material(
        name=name, base_color=(0.0, 0.0, 0.0), roughness=0.0, specular=0.0, ior=ior, absorption=(red, green, blue)
    )
