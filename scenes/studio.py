"""A photographer's studio as a latitude-longitude map: soft boxes in a dark grey room."""

from dataclasses import dataclass

import numpy as np

from lightmeter.scenes.model import Image, Vector
from lightmeter.scenes.optics import environment as optics

HEIGHT = 256


@dataclass(frozen=True)
class SoftBox:
    """A rectangle of light, seen from the middle of the studio.

    Attributes:
        towards: where its middle is; its distance does not matter.
        width, height: of the box, over its distance.
        radiance: W/(sr·m²).
        edge: over which it fades, over its distance.
    """

    towards: Vector
    width: float
    height: float
    radiance: Vector
    edge: float = 0.08

    def seen(self, directions: np.ndarray) -> np.ndarray:
        """(…) how much of its radiance is seen towards unit directions, (3, …): 0…1."""
        axis = np.array(self.towards) / np.linalg.norm(self.towards)
        across = np.cross(axis, (0.0, 0.0, 1.0) if abs(axis[1]) > 0.95 else (0.0, 1.0, 0.0))
        across /= np.linalg.norm(across)
        forward, x, y = (np.tensordot(d, directions, 1) for d in (axis, across, np.cross(across, axis)))
        distance = np.maximum(forward, 1e-9)
        faded = [
            np.clip((half - np.abs(along) / distance) / self.edge + 0.5, 0, 1)
            for half, along in ((self.width / 2, x), (self.height / 2, y))
        ]
        return np.where(forward > 0, faded[0] * faded[1], 0)


BOXES = (
    SoftBox((0.9, 0.8, 0.7), 1.2, 1.0, (9.0, 8.6, 8.0)),  # the key, to the right and above the camera
    SoftBox((-1.0, 0.3, 0.5), 0.6, 1.6, (2.2, 2.4, 2.8)),  # the fill, a tall strip to the left
    SoftBox((-0.2, 0.7, -1.0), 1.6, 0.25, (14.0, 14.0, 14.0)),  # the rim, a narrow strip behind
    SoftBox((0.0, 1.0, 0.0), 0.5, 0.5, (3.0, 3.0, 3.0)),  # overhead
)
CEILING, FLOOR = 0.06, 0.16


def studio(height: int = HEIGHT) -> Image:
    """The map, (height, 2·height, 3)."""
    u, v = np.meshgrid((np.arange(2 * height) + 0.5) / (2 * height), (np.arange(height) + 0.5) / height)
    directions = np.stack(optics.direction_at(u, v, 0.0))
    # A sweep: the floor bends up into the wall without an edge.
    grey = FLOOR + (CEILING - FLOOR) * np.clip(0.5 + directions[1], 0, 1)
    texels = np.repeat(grey[..., None], 3, axis=2)
    for box in BOXES:
        texels += box.seen(directions)[..., None] * np.array(box.radiance)
    return Image(texels.astype(np.float32), "studio")
