"""What a file uses and is not read: every such thing becomes a note, or an error where the file requires it."""

from typing import Any

from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.gltf.source import Source

READ = {
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
}
HARMLESS = {
    "FB_ngon_encoding": "its polygons are seen as triangles, which changes nothing",
    "KHR_xmp_json_ld": "it describes the file and changes nothing in the picture",
}
CONSEQUENCES = {
    "EXT_mesh_gpu_instancing": "instances are left out of both pictures",
    "KHR_materials_dispersion": "colours are not dispersed in either picture",
    "KHR_materials_iridescence": "the thin film is left out of both pictures",
    "KHR_materials_pbrSpecularGlossiness": "the metallic-roughness values beside it are used in both pictures",
    "KHR_materials_unlit": "its shapes are lit like any other in both pictures",
    "KHR_materials_variants": "the default variant is used",
    "KHR_texture_basisu": "an image in KTX2 is left out unless there is a PNG or JPEG beside it",
    "EXT_texture_webp": "an image in WebP is left out unless there is a PNG or JPEG beside it",
}


def note_features(source: Source, content: dict[str, Any]) -> None:
    """Adds a note for every extension and feature of the file that is not read.

    Raises:
        SceneError: the file requires an extension that is not read.
    """
    file = source.document
    for name in file.extensions_required:
        if name not in READ and name not in HARMLESS:
            raise SceneError(
                f"the file requires the extension {name[:80]}, which is not supported",
                where=source.at("extensionsRequired"),
                expected="any of " + ", ".join(sorted(READ)),
                remedy="export the file without it",
            )
    for name in sorted((extension_names(content) | set(file.extensions_used)) - READ):
        consequence = HARMLESS.get(name) or CONSEQUENCES.get(name, "it is left out of both pictures")
        source.note(f"extension {name[:80]} is not read: {consequence}")
    if file.animations:
        source.note("animations are left out: nodes stand where the file places them")
    if file.skins:
        source.note("skins are left out: meshes stand in their bind pose, at their node")


def extension_names(content: Any) -> set[str]:
    """The names of all extensions anywhere in the JSON, whatever the file declares."""
    found: set[str] = set()
    stack = [content]
    while stack:
        value = stack.pop()
        if isinstance(value, dict):
            extensions = value.get("extensions")
            if isinstance(extensions, dict):
                found.update(extensions)
            stack.extend(child for key, child in value.items() if key != "extras")
        elif isinstance(value, list):
            stack.extend(value)
    return found
