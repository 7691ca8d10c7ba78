"""Light reflected from one light at the G-buffer's points: unshadowed (B) and as transported (A).

B is by the optics alone: the light as if nothing else were there (an emissive surface shadows itself, nothing else
does). A is B's integrand times the transport's own factor: nothing in the way, and light and viewer on the same side
of the geometric face. Both come from the same samples.
"""

from collections.abc import Sequence

import numpy as np

from lightmeter.groundtruth import rays
from lightmeter.groundtruth.heuristic import power_heuristic
from lightmeter.groundtruth.incident import incident
from lightmeter.groundtruth.scattering import MULTISCATTER
from lightmeter.groundtruth.to_numpy import rows
from lightmeter.groundtruth.variant import dr, mi
from lightmeter.groundtruth.vertex import MultiscatterVertex, Vertex, Vertices
from lightmeter.groundtruth.wavefront import Lanes, average
from lightmeter.groundtruth.world import World
from lightmeter.scenes.model import AreaLight, Light, PunctualLight
from lightmeter.scenes.optics import material as optics
from lightmeter.scenes.points import SurfacePoints

_STREAM = 0xD1


def reflected(
    world: World, points: SurfacePoints, light: int, spp: int, seed: Sequence[int], shadowed: bool
) -> np.ndarray:
    """B, or with `shadowed` A and B.

    Args:
        light: index into `scene.all_lights`.
        spp: samples per point and strategy; of punctual lights for what has no closed form, where the truth is such.

    Returns:
        (*lead, 3) float32, or (2, *lead, 3): A, B.
    """
    the_light = _light(world, light)
    vertices = Vertices(world, points)
    if isinstance(the_light, AreaLight):
        both = vertices.average(
            spp,
            (*seed, _STREAM, light),
            lambda vertex, lanes: _from_surface(world, the_light, vertex, lanes, shadowed),
            channels=6 if shadowed else 3,
            dimensions=5,
        )
    elif vertices.count == 0:
        both = np.zeros((*vertices.lead, 6 if shadowed else 3), np.float32)
    else:
        further = None
        if world.scattering == MULTISCATTER:
            further = _further_bounces(the_light, vertices, spp, (*seed, _STREAM, light))
        both = vertices.image(_from_punctual(world, the_light, vertices, shadowed, further))
    if world.scene.max_depth == 1 and shadowed:
        both[..., :3] = 0
    return np.ascontiguousarray(np.moveaxis(both.reshape(*vertices.lead, -1, 3), -2, 0)) if shadowed else both


def _light(world: World, index: int) -> Light:
    lights = world.scene.all_lights
    if not 0 <= index < len(lights):
        raise ValueError(f"there is no light {index}, expected 0…{len(lights) - 1}")
    return lights[index]


def _from_punctual(
    world: World, light: PunctualLight, vertices: Vertices, shadowed: bool, further: np.ndarray | None
) -> np.ndarray:
    """(3 or 6, count): in double precision, as it is a closed form; only the shadow ray is single.

    Args:
        further: (3, count) unshadowed radiance to be added; None: nothing.
    """
    lane = dr.arange(mi.UInt32, vertices.count)
    vertex = vertices.at(lane)
    position = mi.Vector3d(vertex.position)
    towards, irradiance, end = incident(light, position)
    normal, view = dr.normalize(mi.Vector3d(vertex.normal)), dr.normalize(mi.Vector3d(vertex.view))
    unshadowed = mi.Color3f(optics.evaluate(vertex.material_in_double, normal, view, towards) * irradiance)
    if further is not None:
        # Row by row: of three arrays a kernel would say how far apart they lie, and be compiled anew for another count.
        unshadowed += dr.gather(mi.Color3f, mi.Float(np.ascontiguousarray(further.T, np.float32).ravel()), lane)
    if not shadowed:
        dr.eval(unshadowed)
        return rows(unshadowed)
    direction = mi.Vector3f(towards)
    it = vertex.interaction
    ray = it.spawn_ray(direction) if end is None else it.spawn_ray_to(mi.Point3f(end + 0 * position))
    lit = rays.clear(world, ray, vertex.carries(direction) & (dr.max(unshadowed) > 0))
    transported = dr.select(lit, unshadowed, 0)
    dr.eval(transported, unshadowed)
    return np.concatenate([rows(transported), rows(unshadowed)])


def _further_bounces(light: PunctualLight, vertices: Vertices, spp: int, seed: Sequence[int]) -> np.ndarray:
    """(3, count): unshadowed radiance by more than one bounce on the microsurface."""

    def estimate(lanes: Lanes):
        vertex = MultiscatterVertex(vertices, lanes)
        towards, irradiance, _ = incident(light, mi.Vector3d(vertex.position))
        return list(vertex.further_bounces(mi.Vector3f(towards)) * mi.Color3f(irradiance))

    return average(vertices.count, spp, seed, estimate, channels=3)


def _from_surface(world: World, light: AreaLight, vertex: Vertex, lanes: Lanes, shadowed: bool):
    """Both strategies, weighted by the power heuristic (Veach & Guibas 1995)."""
    total_a, total_b = mi.Color3f(0), mi.Color3f(0)
    for sample in (_towards_light, _towards_lobe):
        value, direction, ray, active = sample(world, light, vertex, lanes)
        total_b += value
        if shadowed:
            lit = rays.clear(world, ray, active & vertex.carries(direction))
            total_a += dr.select(lit, value, 0)
    return [*total_a, *total_b] if shadowed else list(total_b)


def _towards_light(world: World, light: AreaLight, vertex: Vertex, lanes: Lanes):
    """A point on the light, uniform by area."""
    it = vertex.interaction
    ds, radiance = world.emitter(light).sample_direction(it, lanes.pattern.next_2d(), mi.Bool(True))
    value, density = vertex.evaluate(ds.d)
    active = (ds.pdf > 0) & (dr.max(value) > 0)
    ray = it.spawn_ray_to(ds.p)
    if not world.is_flat(light):
        active &= rays.clear(world, ray, active, scene=world.alone(light))
    value = value * radiance * power_heuristic(ds.pdf, density)
    return dr.select(active, value, 0), ds.d, ray, active


def _towards_lobe(world: World, light: AreaLight, vertex: Vertex, lanes: Lanes):
    """A direction from the material that may find the light."""
    it, emitter = vertex.interaction, world.emitter(light)
    direction, weight, density = vertex.sample(lanes.pattern)
    alone = world.alone(light)
    hit = rays.first_hit(world, it.spawn_ray(direction), density > 0, scene=alone)
    active = (density > 0) & hit.is_valid()
    ds = mi.DirectionSample3f(alone, hit, it)
    light_density = emitter.pdf_direction(it, ds, active)
    value = weight * emitter.eval(hit, active) * power_heuristic(density, light_density)
    return dr.select(active, value, 0), direction, it.spawn_ray_to(hit.p), active
