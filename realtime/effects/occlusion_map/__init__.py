"""glTF's baked occlusion texture as the environment's visibility."""

from lightmeter.scenes.model import Scene

from ...effect import Effect


def unneeded(scene: Scene) -> str:
    """Why the scene does not need it."""
    baked = any("occlusion" in shape.material.textures for shape in scene.shapes)
    return "" if baked else "no material has an occlusion texture"


EFFECT = Effect(
    name="occlusion_map",
    terms=("environment_visibility",),
    summary="The occlusion baked into the material's texture dims the environment.",
    citation="glTF 2.0, 3.9.3 (occlusionTexture, strength)",
    channels=("position", "occlusion"),
    unneeded=unneeded,
)
