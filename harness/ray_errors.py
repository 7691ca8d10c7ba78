"""What becomes of the rays that effects march, and what that costs."""

import numpy as np

from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.mse import rmse
from lightmeter.metrics.objects import by_object
from lightmeter.realtime.renderer import Renderer
from lightmeter.reports.results import RayError, RayPart
from lightmeter.scenes.model import Camera
from lightmeter.scenes.points import SurfacePoints
from lightmeter.scenes.projection import clip_from_camera
from lightmeter.sides import FramePoints, contribution, some_offsets
from lightmeter.stacking import mean_samples
from lightmeter.truth import Truth

MET, WRONG = "met", "wrong"
"""A ray that met something, as the effect says; and one of these that should have met what the camera does not see."""

PIXELS_APART = 4
"""How many pixels' widths a seen point may lie from a traced one and be the same: a surface is seen at a slant, too."""


def ray_errors(renderer: Renderer, truth: Truth, at: FramePoints) -> tuple[RayError, ...]:
    """The squared error of every effect with verdicts, split by them.

    Rays that met something are wrong hits where a traced ray meets what the camera does not see.

    Args:
        at: the frame's points, at which the oracles are known. The sample nearest to the pixel's centre stands for it.
    """
    plan = renderer.plan
    centre = at.captures[int(np.argmin(np.linalg.norm(some_offsets(renderer.offsets), axis=1)))]
    found = []
    for name, verdicts in centre.verdicts.items():
        tested, exact = [], []
        for number in range(truth.batches):
            batch = truth.batch(at.points, number, "frame", at.spp, terms=plan.terms_of(name))
            for images, image in zip((tested, exact), contribution(plan, name, at.captures, batch), strict=True):
                images.append(mean_samples(image))
        comparison = Comparison(tested, exact)
        known = (*plan.effects[name][0].verdicts, WRONG)
        unseen = ~seen_on_screen(centre.points, truth.mirrored_hits(centre.points), plan.scene.camera)
        fates = np.where((verdicts == known.index(MET)) & unseen, known.index(WRONG), verdicts)
        shares = by_object(comparison, np.where(centre.points.hit, fates, -1))
        nothing = RayPart(0, Measurement(0.0, how="no pixel"))
        parts = {
            verdict: RayPart(shares[number].pixels, shares[number].share) if number in shares else nothing
            for number, verdict in enumerate(known)
        }
        found.append(RayError(name, rmse(comparison), parts))
    return tuple(found)


def seen_on_screen(points: SurfacePoints, traced: np.ndarray, camera: Camera) -> np.ndarray:
    """(H, W) boolean: whether a pixel's traced point is among what the camera sees, from the side that was met.

    Args:
        points: what the camera sees, (H, W).
        traced: (2, H, W, 3) for every pixel a point and the normal of the side that was met; 0: none.
    """
    height, width = points.shape.shape
    place, side = traced.astype(np.float64)
    matrix = clip_from_camera(camera, (width, height)) @ np.linalg.inv(camera.matrix)
    clip = place @ matrix[:, :3].T + matrix[:, 3]
    towards = camera.matrix[:3, 2] if camera.yfov is None else camera.position - place
    w = np.where(clip[..., 3] > 0, clip[..., 3], 1.0)
    column, row = (clip[..., 0] / w + 1) / 2 * width, (1 - clip[..., 1] / w) / 2 * height
    inside = (np.sum(side * towards, axis=-1) > 0) & (clip[..., 3] > 0)
    inside &= (column >= 0) & (column < width) & (row >= 0) & (row < height)
    pixel_width = 2 * w / (clip_from_camera(camera, (width, height))[1, 1] * height)
    nearest = np.full((height, width), np.inf)
    for down in (-1, 0, 1):
        for right in (-1, 0, 1):
            r = np.clip(np.floor(row).astype(int) + down, 0, height - 1)
            c = np.clip(np.floor(column).astype(int) + right, 0, width - 1)
            apart = np.linalg.norm(points.position[r, c] - place, axis=-1)
            nearest = np.minimum(nearest, np.where(points.hit[r, c], apart, np.inf))
    return inside & (nearest <= PIXELS_APART * pixel_width)
