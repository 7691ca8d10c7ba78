"""Rays through the world, with the holes of alpha masks open."""

from lightmeter.groundtruth import surface
from lightmeter.groundtruth.variant import dr, mi
from lightmeter.groundtruth.world import World

_MASK_SLOTS = frozenset({"base_color", "color"})


def _through_holes(world: World, scene, ray, active):
    """The first hit that is there, or an invalid one."""
    slots = world.slots & _MASK_SLOTS

    def step(si, ray, going):
        si = scene.ray_intersect(ray, ray_flags=+mi.RayFlags.All, coherent=False, active=going)
        going &= si.is_valid()
        going &= ~surface.at_hit(world.tables, si, slots, going).present
        onwards = si.spawn_ray(ray.d)
        onwards.maxt = ray.maxt - si.t
        return si, dr.select(going, onwards, ray), going

    nothing = dr.zeros(mi.SurfaceInteraction3f, dr.width(ray))
    state = (nothing, mi.Ray3f(ray), mi.Bool(active) & dr.full(mi.Bool, True, dr.width(ray)))
    return dr.while_loop(state, lambda si, ray, going: going, step, label="through holes")[0]


def first_hit(world: World, ray, active, scene=None):
    """The first surface along rays that is there (SurfaceInteraction3f; invalid where there is none).

    Args:
        scene: another `mi.Scene` of the same world's meshes (see `World.alone`).
    """
    scene = world.mitsuba if scene is None else scene
    if not world.masked:
        return scene.ray_intersect(ray, ray_flags=+mi.RayFlags.All, coherent=False, active=active)
    return _through_holes(world, scene, ray, active)


def clear(world: World, ray, active, scene=None):
    """Bool: whether nothing is in the way along rays, up to their `maxt`."""
    scene = world.mitsuba if scene is None else scene
    if not world.masked:
        return active & ~scene.ray_test(ray, active)
    return active & ~_through_holes(world, scene, ray, active).is_valid()
