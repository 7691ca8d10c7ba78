"""What the layers of a scene's materials need to be told at a point; a layer that no material has needs nothing."""

from .model import Scene

COAT = ("clearcoat", "clearcoat_roughness", "clearcoat_normal")
LAYER_CHANNELS = {"coat": COAT}
"""The parameters of each layer, as `SurfacePoints` names them."""


def layer_channels(scene: Scene) -> tuple[str, ...]:
    """The parameters that the scene's layers have; a coat's normal only where it may differ from its base's."""
    coated = [shape.material for shape in scene.shapes if "coat" in shape.material.layers]
    if not coated:
        return ()
    own_normal = any(not material.textures.keys().isdisjoint({"normal", "clearcoat_normal"}) for material in coated)
    return COAT if own_normal else COAT[:2]
