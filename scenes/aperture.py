"""The opening that light enters a camera by, as far as diffraction at it goes."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Aperture:
    """A circle, or a regular polygon of the same area.

    Attributes:
        f_number: focal length over the circle's diameter.
        blades: corners of the polygon, at least 3; 0: a circle.
        rotation: radians by which the polygon is turned, anticlockwise as seen in the picture; at 0 a corner points up.
        sensor_height: metres that the picture's height takes on the sensor.
    """

    f_number: float = 8.0
    blades: int = 0
    rotation: float = 0.0
    sensor_height: float = 0.024

    @property
    def corners(self) -> np.ndarray:
        """(blades, 2) float64: right and up, in diameters of the circle; none for a circle."""
        angles = np.pi / 2 + self.rotation + 2 * np.pi * np.arange(self.blades) / max(self.blades, 1)
        # ½·n·R²·sin(2π/n) = π/4
        radius = np.sqrt(np.pi / 2 / max(self.blades * np.sin(2 * np.pi / max(self.blades, 1)), 1e-9))
        return radius * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
