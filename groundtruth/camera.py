"""Primary rays: the scene's camera looks along −Z with +Y up; pixel (0, 0) is the top left one.

The rays are made here rather than by a Mitsuba sensor: there are no clipping planes (the near plane is the real-time
side's affair), the sub-pixel positions can be given, and an image is summed in a fixed order, which makes a batch
repeatable to the bit. A test holds them against Mitsuba's own `perspective`.
"""

import math

import numpy as np

from lightmeter.groundtruth.variant import dr, mi
from lightmeter.scenes.model import Camera


class PrimaryRays:
    """The rays of a camera for an image of a given size.

    Args:
        size: (width, height) in pixels.
    """

    def __init__(self, camera: Camera, size: tuple[int, int]):
        width, height = size
        right, up, back = (camera.matrix[:3, i] / np.linalg.norm(camera.matrix[:3, i]) for i in range(3))
        half = math.tan(camera.yfov / 2) if camera.yfov is not None else camera.ymag
        # A point of the image plane is origin + x·across + y·down, x and y in pixels.
        across, down = 2 * half / height * right, -2 * half / height * up
        corner = -0.5 * width * across - 0.5 * height * down
        self.perspective = camera.yfov is not None
        vectors = (camera.position, across, down, corner, -back)
        self.position, self.across, self.down, self.corner, self.forward = (
            mi.Vector3f(*map(float, v)) for v in vectors
        )
        self.width = mi.UInt32(width)
        dr.make_opaque(self.position, self.across, self.down, self.corner, self.forward, self.width)

    def through(self, pixel, u, v):
        """Ray3f through pixels (UInt32, row by row from the top) at u to the right and v down, 0…1 within each."""
        row = pixel // self.width
        x, y = mi.Float(pixel - row * self.width) + u, mi.Float(row) + v
        plane = self.corner + x * self.across + y * self.down
        if self.perspective:
            return mi.Ray3f(mi.Point3f(self.position), dr.normalize(plane + self.forward))
        return mi.Ray3f(mi.Point3f(self.position + plane), self.forward)
