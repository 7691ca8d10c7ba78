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


def world_from_pixel(camera: Camera, size: tuple[int, int], offset: tuple[float, float] = (0.0, 0.0)) -> np.ndarray:
    """(4, 4) float64: world space from (x·z, y·z, z, 1), or from (x, y, z, 1) where rays are parallel.

    Args:
        size: width and height in pixels; x and y count them from the bottom left, z is the distance along the view.
        offset: where in the pixel the scene was sampled, in pixels right and down from its centre.
    """
    width, height = size
    scale = clip_from_camera(camera, size)
    half_width, half_height = 1 / scale[0, 0], 1 / scale[1, 1]  # at distance 1, where rays spread
    corner = (2 * offset[0] / width - 1) * half_width, (-2 * offset[1] / height - 1) * half_height
    to_camera = np.zeros((4, 4))
    to_camera[0, 0], to_camera[1, 1] = 2 * half_width / width, 2 * half_height / height
    to_camera[2, 2], to_camera[3, 3] = -1, 1
    to_camera[:2, 2 if camera.yfov is not None else 3] = corner
    return camera.matrix @ to_camera


def viewer(camera: Camera) -> np.ndarray:
    """(4,) what gives shaders the direction to the viewer: position and 1, or for parallel rays direction and 0."""
    if camera.yfov is not None:
        return np.append(camera.position, 1.0)
    return np.append(camera.matrix[:3, 2] / np.linalg.norm(camera.matrix[:3, 2]), 0.0)
