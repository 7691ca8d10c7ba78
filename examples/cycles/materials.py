"""What Blender's glTF importer makes of materials, brought nearer to glTF's definition."""

from collections.abc import Iterable

import bpy


def follow_gltf(materials: Iterable[bpy.types.Material]) -> None:
    """Single scattering everywhere; backs of single-sided materials absorb, and emit nothing."""
    for material in materials:
        if not material.use_nodes:
            continue
        nodes, links = material.node_tree.nodes, material.node_tree.links
        for node in nodes:
            if node.type == "BSDF_PRINCIPLED":
                node.distribution = "GGX"  # Blender's default, MULTI_GGX, adds multiple scattering back
        if not material.use_backface_culling:  # what the importer makes of doubleSided
            continue
        surface = next(node for node in nodes if node.type == "OUTPUT_MATERIAL").inputs["Surface"]
        front = surface.links[0].from_socket
        black, mix = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeMixShader")
        black.inputs["Color"].default_value = (0, 0, 0, 1)
        links.new(nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"], mix.inputs[0])
        links.new(front, mix.inputs[1])
        links.new(black.outputs[0], mix.inputs[2])
        links.new(mix.outputs[0], surface)
