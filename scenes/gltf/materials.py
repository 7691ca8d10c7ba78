"""Materials (glTF 2.0, section 3.9; KHR_materials_emissive_strength, _specular, _clearcoat, _anisotropy, _sheen,
_transmission with _volume and _ior)."""

from typing import Any

from lightmeter.scenes.glass import glass
from lightmeter.scenes.gltf import document
from lightmeter.scenes.gltf.features import HARMLESS, READ
from lightmeter.scenes.gltf.source import Source
from lightmeter.scenes.gltf.textures import Textures
from lightmeter.scenes.model import Material, Mesh

DEFAULT = Material(name="glTF default", metallic=1.0, roughness=1.0)
"""What a primitive without a material has (section 3.9.6)."""


class Materials:
    """The materials of one file; each is read once, when a primitive first uses it."""

    def __init__(self, source: Source):
        self._source = source
        self._textures = Textures(source)
        self._read: dict[int, Material] = {}

    def blended(self, index: int | None, mesh: Mesh) -> bool:
        """Whether a mesh of this material is really see-through: blended, and not of opacity 1 throughout.

        Raises:
            SceneError: the material or its base colour's image is wrong.
        """
        if index is None:
            return False
        part = self._part(index)
        if part.alpha_mode != "BLEND":
            return False
        material = self.material(index)
        texture = material.base_color_texture
        texture_opaque = texture is None or texture.image.texels.shape[2] < 4 or (
            texture.image.texels[:, :, 3].min(initial=255) == 255
        )  # fmt: skip
        colors_opaque = mesh.colors is None or mesh.colors[:, 3].min(initial=1) == 1
        return not (material.alpha == 1 and texture_opaque and colors_opaque)

    def material(self, index: int | None) -> Material:
        """The material `index`, or glTF's default.

        Raises:
            SceneError: it, or one of its textures, is wrong.
        """
        if index is None:
            return DEFAULT
        if index not in self._read:
            self._read[index] = self._material(self._part(index), index)
        return self._read[index]

    def _part(self, index: int) -> document.Material:
        return self._source.get("materials", self._source.document.materials, index, "primitive.material")

    def _material(self, part: document.Material, index: int) -> Material:
        source, read = self._source, self._textures.texture
        place = f"materials[{index}]"
        if (solid := self._solid(part, place)) is not None:
            return solid
        pbr = part.metallic_roughness
        base = f"{place}.pbrMetallicRoughness"
        strength = source.extension(part, "KHR_materials_emissive_strength", document.EmissiveStrength, place)
        factor = strength.strength if strength else 1.0
        red, green, blue, alpha = pbr.base_color
        normal, occlusion = part.normal_texture, part.occlusion_texture
        return Material(
            name=part.name or place,
            base_color=(red, green, blue),
            alpha=alpha,
            metallic=pbr.metallic,
            roughness=pbr.roughness,
            specular=self._specular(part, place),
            emissive=(part.emissive[0] * factor, part.emissive[1] * factor, part.emissive[2] * factor),
            base_color_texture=read(pbr.base_color_texture, True, f"{base}.baseColorTexture"),
            metallic_roughness_texture=read(pbr.metallic_roughness_texture, False, f"{base}.metallicRoughnessTexture"),
            normal_texture=read(normal, False, f"{place}.normalTexture"),
            normal_scale=normal.scale if normal else 1.0,
            occlusion_texture=read(occlusion, False, f"{place}.occlusionTexture"),
            occlusion_strength=occlusion.strength if occlusion else 1.0,
            emissive_texture=read(part.emissive_texture, True, f"{place}.emissiveTexture"),
            alpha_mode="mask" if part.alpha_mode == "MASK" else "opaque",
            alpha_cutoff=part.alpha_cutoff,
            double_sided=part.double_sided,
            **self._coat(part, place),
            **self._grain(part, place),
            **self._sheen(part, place),
            left_out=tuple(sorted(set(part.extensions) - READ - set(HARMLESS))),
        )

    def _solid(self, part: document.Material, place: str) -> Material | None:
        """The material of a dielectric solid: all its light is transmitted, and it has an inside; else None."""
        source, name = self._source, part.name or place
        transmission = source.extension(part, "KHR_materials_transmission", document.Transmission, place)
        volume = source.extension(part, "KHR_materials_volume", document.Volume, place)
        index = source.extension(part, "KHR_materials_ior", document.Ior, place)
        ior = index.ior if index else 1.5
        if transmission is None or transmission.factor == 0:
            if index is not None and ior != 1.5:
                source.note(f"{name}: KHR_materials_ior is read of solids alone; its index is 1.5 in both pictures")
            return None
        reasons = {
            "in part": transmission.factor < 1 or transmission.texture is not None,
            "without an inside (KHR_materials_volume)": volume is None or volume.thickness == 0,
            f"with an index of {ior:g}": ior <= 1,
        }
        if volume is None or any(reasons.values()):
            why = next(words for words, holds in reasons.items() if holds)
            source.note(f"{name}: what is transparent {why} is opaque in both pictures")
            return None
        pbr = part.metallic_roughness
        if pbr.roughness > 0 or pbr.metallic_roughness_texture or part.normal_texture:
            source.note(f"{name}: its surface is smooth in both pictures")
        if pbr.base_color[:3] != (1, 1, 1) or pbr.base_color_texture:
            source.note(f"{name}: its surface does not tint light in either picture, only its inside does")
        color = volume.attenuation_color
        if min(color) == 0:
            source.note(f"{name}: attenuationColor has a 0, which no distance leaves; 1e-6 stands for it")
        red, green, blue = (max(value, 1e-6) for value in color)
        return glass(name, ior, (red, green, blue), volume.attenuation_distance)

    def _coat(self, part: document.Material, place: str) -> dict[str, Any]:
        """The parameters of a coat, where there is one: a factor of 0 disables the layer with its textures."""
        name = "KHR_materials_clearcoat"
        coat = self._source.extension(part, name, document.ClearCoat, place)
        if coat is None or coat.factor == 0:
            return {}
        if max(part.emissive) > 0:
            self._source.note(f"{part.name or place}: the coat does not darken its emission in either picture")
        read, here = self._textures.texture, f"{place}.extensions.{name}"
        return {
            "clearcoat": coat.factor,
            "clearcoat_roughness": coat.roughness,
            "clearcoat_texture": read(coat.texture, False, f"{here}.clearcoatTexture"),
            "clearcoat_roughness_texture": read(coat.roughness_texture, False, f"{here}.clearcoatRoughnessTexture"),
            "clearcoat_normal_texture": read(coat.normal_texture, False, f"{here}.clearcoatNormalTexture"),
            "clearcoat_normal_scale": coat.normal_texture.scale if coat.normal_texture else 1.0,
        }

    def _grain(self, part: document.Material, place: str) -> dict[str, Any]:
        """The parameters of anisotropy, where there is any."""
        name = "KHR_materials_anisotropy"
        grain = self._source.extension(part, name, document.Anisotropy, place)
        if grain is None or grain.strength == 0:
            return {}
        here = f"{place}.extensions.{name}.anisotropyTexture"
        return {
            "anisotropy": grain.strength,
            "anisotropy_rotation": grain.rotation,
            "anisotropy_texture": self._textures.texture(grain.texture, False, here),
        }

    def _sheen(self, part: document.Material, place: str) -> dict[str, Any]:
        """The parameters of a sheen, where there is one."""
        name = "KHR_materials_sheen"
        sheen = self._source.extension(part, name, document.Sheen, place)
        if sheen is None or max(sheen.color) == 0:
            return {}
        read, here = self._textures.texture, f"{place}.extensions.{name}"
        return {
            "sheen_color": sheen.color,
            "sheen_roughness": sheen.roughness,
            "sheen_color_texture": read(sheen.color_texture, True, f"{here}.sheenColorTexture"),
            "sheen_roughness_texture": read(sheen.roughness_texture, False, f"{here}.sheenRoughnessTexture"),
        }

    def _specular(self, part: document.Material, place: str) -> float:
        specular = self._source.extension(part, "KHR_materials_specular", document.Specular, place)
        if specular is None:
            return 1.0
        if specular.color != (1, 1, 1) or specular.texture or specular.color_texture:
            self._source.note(
                "KHR_materials_specular: only specularFactor is read; specularColorFactor and the textures are "
                "left out of both pictures"
            )
        return specular.factor
