"""What the layers of a scene's materials need to be told at a point; a layer that no material has needs nothing."""

from .model import Scene

COAT = ("clearcoat", "clearcoat_roughness", "clearcoat_normal")
GRAIN = ("anisotropy", "anisotropy_direction")
SHEEN = ("sheen_color", "sheen_roughness")
GLASS = ("absorption", "ior")
LAYER_CHANNELS = {"coat": COAT, "grain": GRAIN, "sheen": SHEEN, "glass": GLASS}
"""The parameters of each layer, and of a solid's inside, as `SurfacePoints` names them."""


def layer_channels(scene: Scene) -> tuple[str, ...]:
    """The parameters that the scene's layers have; a coat's normal only where it may differ from its base's."""
    materials = [shape.material for shape in scene.shapes]
    coated = [material for material in materials if "coat" in material.layers]
    found: tuple[str, ...] = ()
    if coated:
        found += COAT if any(material.has_normal_map for material in coated) else COAT[:2]
    if any("grain" in material.layers for material in materials):
        found += GRAIN
    if any("sheen" in material.layers for material in materials):
        found += SHEEN
    if any(material.is_glass for material in materials):
        found += GLASS
    return found
