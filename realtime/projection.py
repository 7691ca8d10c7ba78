"""The camera's matrices, with the conventions of `scenes.model`."""

import numpy as np

from lightmeter.scenes.model import Camera
from lightmeter.scenes.projection import clip_from_camera


def view_matrix(camera: Camera) -> np.ndarray:
    """(4, 4) float64: world to camera."""
    return np.linalg.inv(camera.matrix)


def projection_matrix(camera: Camera, size: tuple[int, int], offset: tuple[float, float] = (0.0, 0.0)) -> np.ndarray:
    """(4, 4) float64: camera to clip space.

    Args:
        size: width and height in pixels; the height holds the camera's field, the width follows.
        offset: where in the pixel the scene is sampled, in pixels right and down from its centre.
    """
    width, height = size
    # Sampling further right moves the picture left; image rows run down, clip space runs up.
    shift = np.eye(4)
    shift[0, 3], shift[1, 3] = -2 * offset[0] / width, 2 * offset[1] / height
    return shift @ clip_from_camera(camera, size)


def viewer(camera: Camera) -> np.ndarray:
    """(4,) what gives shaders the direction to the viewer: position and 1, or for parallel rays direction and 0."""
    if camera.yfov is not None:
        return np.append(camera.position, 1.0)
    return np.append(camera.matrix[:3, 2] / np.linalg.norm(camera.matrix[:3, 2]), 0.0)
