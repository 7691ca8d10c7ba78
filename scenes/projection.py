"""From camera space to clip space, as OpenGL has it."""

import numpy as np

from .model import Camera


def clip_from_camera(camera: Camera, size: tuple[int, int]) -> np.ndarray:
    """(4, 4) float64: camera to clip space, z/w from −1 (near) to 1 (far).

    Args:
        camera: perspective or orthographic.
        size: width and height in pixels; the height holds the camera's field, the width follows.
    """
    width, height = size
    near, far = camera.near, camera.far
    matrix = np.zeros((4, 4))
    if camera.yfov is not None:
        scale = 1 / np.tan(camera.yfov / 2)
        matrix[2] = 0, 0, (far + near) / (near - far), 2 * far * near / (near - far)
        matrix[3, 2] = -1
    else:
        scale = 1 / camera.ymag
        matrix[2] = 0, 0, 2 / (near - far), (far + near) / (near - far)
        matrix[3, 3] = 1
    matrix[0, 0], matrix[1, 1] = scale * height / width, scale
    return matrix
