"""Emissive surfaces, for effects that light with them or shadow them."""

from lightmeter.scenes.model import AreaLight, Light, Scene


def emissive(_scene: Scene, light: Light) -> bool:
    """Every light with an extent."""
    return isinstance(light, AreaLight)
