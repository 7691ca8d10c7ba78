"""`glare`: the image convolved with the diffraction of the camera's aperture, channel by channel.

What would arrive from outside the picture is not known and taken as black; what leaves it is lost.
"""

import numpy as np

from lightmeter.groundtruth.diffraction import point_spread
from lightmeter.scenes.model import Camera

TERM = "glare"


def evaluate(image: np.ndarray, camera: Camera) -> np.ndarray:
    """The image with its glare.

    Args:
        image: (H, W, 3) scene-linear.
        camera: with an aperture.

    Returns:
        (H, W, 3) float32; pixels that are not finite stay so, and give no glare.
    """
    from scipy.signal import fftconvolve

    assert camera.aperture is not None
    height, width = image.shape[:2]
    sound = np.isfinite(image).all(axis=-1, keepdims=True)
    # Beyond float32's range of what lies beside a sun, rounding of the transform is 1e-16 of it.
    light = np.where(sound, image, 0.0).astype(np.float64)
    spread = point_spread(camera.aperture, (width, height))
    glared = fftconvolve(light, spread, mode="same", axes=(0, 1))
    return np.where(sound, np.maximum(glared, 0.0), image).astype(np.float32)
