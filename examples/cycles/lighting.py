"""Lights and surroundings, from radiometric units to Blender's."""

import math
from pathlib import Path

import bpy
from mathutils import Matrix, Vector


def add_light(told: dict, z_up: Matrix) -> None:
    """A light of camera.json. Emissive surfaces are lights in Cycles already.

    A sun's strength is its irradiance (W/m²). A point's power is Blender's "radiant flux" P, spread over the sphere:
    I = P / 4π; a spot is a point that a cone cuts, with the same I.
    """
    if told["kind"] == "area":
        return
    data = bpy.data.lights.new(told["name"], {"directional": "SUN"}.get(told["kind"], told["kind"].upper()))
    if told["kind"] == "directional":
        data.angle = 0
        value = told["irradiance_w_per_m2"]
        data.energy = max(value)
    else:
        data.shadow_soft_size = 0
        value = told["intensity_w_per_sr"]
        data.energy = 4 * math.pi * max(value)
    data.color = [channel / max(value) for channel in value] if max(value) > 0 else (0, 0, 0)
    if told["kind"] == "spot":
        data.spot_size = 2 * told["outer_rad"]
        inner, outer = math.cos(told["inner_rad"]), math.cos(told["outer_rad"])
        data.spot_blend = (inner - outer) / (1 - outer)  # the part of the cone, in cosines, that fades
    made = bpy.data.objects.new(told["name"], data)
    forward = Vector(told.get("direction", (0, 0, -1)))
    place, turn = Matrix.Translation(told.get("position_m", (0, 0, 0))), forward.to_track_quat("-Z", "Y")
    made.matrix_world = z_up @ place @ turn.to_matrix().to_4x4()
    bpy.context.collection.objects.link(made)


def surround(path: Path) -> None:
    """A lat-long map, lighting and seen; with Z up Cycles looks it up as camera.json says."""
    world = bpy.data.worlds.new("world")
    bpy.context.scene.world = world
    world.use_nodes = True
    nodes = world.node_tree.nodes
    texture = nodes.new("ShaderNodeTexEnvironment")
    texture.image = bpy.data.images.load(str(path))
    texture.image.colorspace_settings.name = "Linear Rec.709"
    world.node_tree.links.new(texture.outputs["Color"], nodes["Background"].inputs["Color"])
