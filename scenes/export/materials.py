"""Materials (glTF 2.0, section 3.9; KHR_materials_emissive_strength, _specular, _clearcoat,
_anisotropy, _sheen)."""

import math
from typing import Any

from ..errors import SceneError
from ..model import Material, Texture
from .radiant import color_and_strength
from .textures import Textures

EMISSIVE_STRENGTH, SPECULAR = "KHR_materials_emissive_strength", "KHR_materials_specular"
CLEARCOAT, ANISOTROPY = "KHR_materials_clearcoat", "KHR_materials_anisotropy"
SHEEN = "KHR_materials_sheen"
TRANSMISSION, IOR, VOLUME = "KHR_materials_transmission", "KHR_materials_ior", "KHR_materials_volume"
CODING = {True: "sRGB", False: "linear"}
COLOURED = ("base_color", "emissive", "sheen_color")
"""The textures whose colours glTF takes for sRGB-encoded; the others are linear."""


class Materials:
    """The materials of one file; each is written once.

    Attributes:
        materials: glTF's array.
        textures: what they look up.
        extensions: which extensions were used.
    """

    def __init__(self):
        self.materials: list[dict[str, Any]] = []
        self.textures = Textures()
        self.extensions: set[str] = set()
        self._numbers: dict[Material, int] = {}

    def number(self, material: Material) -> int:
        """Where a material stands in `materials`.

        Raises:
            SceneError: PNG cannot hold a texture, or glTF would decode it otherwise.
        """
        if material not in self._numbers:
            self._numbers[material] = len(self.materials)
            self.materials.append(self._content(material))
        return self._numbers[material]

    def _texture(self, material: Material, slot: str, texture: Texture) -> dict[str, Any]:
        if texture.srgb != (slot in COLOURED):
            raise SceneError(
                f"the {slot} texture of material {material.name!r} cannot be exported: glTF says how it is encoded",
                expected=CODING[slot in COLOURED],
                actual=CODING[texture.srgb],
                remedy=f"encode its texels, and set srgb={slot in COLOURED}",
            )
        return self.textures.info(texture)

    def _content(self, material: Material) -> dict[str, Any]:
        info = {slot: self._texture(material, slot, texture) for slot, texture in material.textures.items()}
        pbr: dict[str, Any] = {
            "baseColorFactor": [*material.base_color, material.alpha],
            "metallicFactor": material.metallic,
            "roughnessFactor": material.roughness,
        }
        if "base_color" in info:
            pbr["baseColorTexture"] = info["base_color"]
        if "metallic_roughness" in info:
            pbr["metallicRoughnessTexture"] = info["metallic_roughness"]
        content: dict[str, Any] = {
            "name": material.name,
            "pbrMetallicRoughness": pbr,
            "doubleSided": material.double_sided,
        }
        if "normal" in info:
            content["normalTexture"] = info["normal"] | {"scale": material.normal_scale}
        if "occlusion" in info:
            content["occlusionTexture"] = info["occlusion"] | {"strength": material.occlusion_strength}
        if "emissive" in info:
            content["emissiveTexture"] = info["emissive"]
        if material.alpha_mode == "mask":
            content |= {"alphaMode": "MASK", "alphaCutoff": material.alpha_cutoff}
        content["emissiveFactor"], strength = color_and_strength(material.emissive)
        extensions = {}
        if strength != 1:
            extensions[EMISSIVE_STRENGTH] = {"emissiveStrength": strength}
        if material.specular != 1:
            extensions[SPECULAR] = {"specularFactor": material.specular}
        if "coat" in material.layers:
            extensions[CLEARCOAT] = _coat(material, info)
        if "grain" in material.layers:
            extensions[ANISOTROPY] = _grain(material, info)
        if "sheen" in material.layers:
            extensions[SHEEN] = _sheen(material, info)
        if material.is_glass:
            pbr |= {"baseColorFactor": [1.0, 1.0, 1.0, 1.0], "roughnessFactor": 0.0}
            extensions = _solid(material)
        if extensions:
            content["extensions"] = extensions
            self.extensions |= set(extensions)
        return content


def _solid(material: Material) -> dict[str, dict[str, Any]]:
    """KHR_materials_transmission, _ior and _volume of a dielectric solid; path tracers take any thickness above 0."""
    volume: dict[str, Any] = {"thicknessFactor": 1.0}
    if max(material.absorption) > 0:
        volume |= {"attenuationDistance": 1.0, "attenuationColor": [math.exp(-value) for value in material.absorption]}
    return {TRANSMISSION: {"transmissionFactor": 1.0}, IOR: {"ior": material.ior}, VOLUME: volume}


def _coat(material: Material, info: dict[str, dict[str, Any]]) -> dict[str, Any]:
    """KHR_materials_clearcoat; `info` holds the textures by slot."""
    coat: dict[str, Any] = {
        "clearcoatFactor": material.clearcoat,
        "clearcoatRoughnessFactor": material.clearcoat_roughness,
    }
    if "clearcoat" in info:
        coat["clearcoatTexture"] = info["clearcoat"]
    if "clearcoat_roughness" in info:
        coat["clearcoatRoughnessTexture"] = info["clearcoat_roughness"]
    if "clearcoat_normal" in info:
        coat["clearcoatNormalTexture"] = info["clearcoat_normal"] | {"scale": material.clearcoat_normal_scale}
    return coat


def _grain(material: Material, info: dict[str, dict[str, Any]]) -> dict[str, Any]:
    """KHR_materials_anisotropy."""
    grain = {"anisotropyStrength": material.anisotropy, "anisotropyRotation": material.anisotropy_rotation}
    return grain | ({"anisotropyTexture": info["anisotropy"]} if "anisotropy" in info else {})


def _sheen(material: Material, info: dict[str, dict[str, Any]]) -> dict[str, Any]:
    """KHR_materials_sheen."""
    sheen: dict[str, Any] = {
        "sheenColorFactor": list(material.sheen_color),
        "sheenRoughnessFactor": material.sheen_roughness,
    }
    if "sheen_color" in info:
        sheen["sheenColorTexture"] = info["sheen_color"]
    if "sheen_roughness" in info:
        sheen["sheenRoughnessTexture"] = info["sheen_roughness"]
    return sheen
