"""Surface points by ray casting: what an exact G-buffer would hold, without a rasteriser."""

import numpy as np

from lightmeter.groundtruth import rays, surface
from lightmeter.groundtruth.camera import PrimaryRays
from lightmeter.groundtruth.oracles import material
from lightmeter.groundtruth.variant import dr, mi
from lightmeter.groundtruth.wavefront import Lanes, average
from lightmeter.groundtruth.world import World
from lightmeter.scenes.optics import environment
from lightmeter.scenes.points import SurfacePoints


def surface_points(world: World, size: tuple[int, int], offsets: np.ndarray | None = None) -> SurfacePoints:
    """What the camera sees, one point per pixel, with exact parameters.

    Args:
        size: (width, height).
        offsets: (H, W, 2) or (2,): where in each pixel, x to the right and y down, 0…1; the centre if None.
    """
    width, height = size
    if offsets is None:
        offsets = np.array([0.5, 0.5])
    spread = np.broadcast_to(offsets, (height, width, 2)).astype(np.float32).reshape(-1, 2)
    pixel = dr.arange(mi.UInt32, width * height)
    u, v = dr.gather(mi.Vector2f, mi.Float(spread.ravel()), pixel)
    ray = PrimaryRays(world.scene.camera, size).through(pixel, u, v)
    hit = rays.first_hit(world, ray, mi.Bool(True))
    seen = hit.is_valid()
    shape = dr.select(seen, mi.Int32(surface.shape_index(world.tables, hit.shape, seen)), -1)
    triangle = dr.select(seen, mi.Int32(hit.prim_index), -1)
    view = -ray.d
    dr.eval(hit.p, view, shape, triangle)
    zero, black = np.zeros((height, width), np.float32), np.zeros((height, width, 3), np.float32)
    towards = np.broadcast_to(ray.d.numpy().T, (height * width, 3)).astype(np.float64)
    around = world.scene.environment
    sky = black if around is None else environment.radiance(around, towards.T).T.reshape(height, width, 3)
    bare = SurfacePoints(
        position=world.frame.leave(hit.p.numpy().T).reshape(height, width, 3),
        normal=black,
        view=np.broadcast_to(view.numpy().T, (height * width, 3)).reshape(height, width, 3),
        base_color=black,
        metallic=zero,
        roughness=zero,
        specular=zero,
        occlusion=zero,
        emission=sky.astype(np.float32),
        shape=shape.numpy().reshape(height, width),
        triangle=triangle.numpy().reshape(height, width),
    )
    return material.evaluate(world, bare)


def seen_places(world: World, size: tuple[int, int]) -> np.ndarray:
    """(N, 3) float32: what is seen at the pixels' centres, in the world's frame."""
    pixel, middle = dr.arange(mi.UInt32, size[0] * size[1]), mi.Float(0.5)
    hit = rays.first_hit(world, PrimaryRays(world.scene.camera, size).through(pixel, middle, middle), mi.Bool(True))
    place, seen = hit.p, hit.is_valid()
    dr.eval(place, seen)
    return place.numpy().T[seen.numpy()]


_STREAM = 0x5EE


def seen_emission(
    world: World, size: tuple[int, int], offset: np.ndarray | None = None, *, spp: int = 256, seed: int = 0
) -> np.ndarray:
    """What the first surface seen through each pixel emits, or the environment's radiance where none is.

    With `offset` at one place of every pixel, else averaged over the pixels. The difference of the two has mean 0 for
    random offsets, and holds nearly all the noise that a G-buffer's shared offset puts into an image with bright
    lights in it. So it is a control variate for closure: composition − (at its own offset) + (averaged).

    Args:
        size: (width, height).
        offset: (2,), x to the right and y down, 0…1 within the pixel.
        spp: samples per pixel, where there is no `offset`.

    Returns:
        (H, W, 3) float32, W/(sr·m²).
    """
    width, height = size
    rays_through = PrimaryRays(world.scene.camera, size)
    here = None if offset is None else (mi.Float(float(offset[0])), mi.Float(float(offset[1])))
    if here is not None:
        dr.make_opaque(*here)

    def estimate(lanes: Lanes):
        u, v = here or (lanes.pattern.next(), lanes.pattern.next())
        hit = rays.first_hit(world, rays_through.through(lanes.place, u, v), mi.Bool(True))
        return list(hit.emitter(world.mitsuba).eval(hit))

    image = average(width * height, spp if here is None else 1, (seed, _STREAM), estimate, channels=3, dimensions=2)
    return np.ascontiguousarray(image.T).reshape(height, width, 3)
