"""`exposure`: the image brightened as the camera's metering rule says of its exact luminances."""

import numpy as np

from lightmeter.scenes.model import Camera

TERM = "exposure"


def evaluate(image: np.ndarray, camera: Camera) -> np.ndarray:
    """The exposed image.

    Args:
        image: (H, W, 3) scene-linear, glare included.
        camera: with metering, or with an exposure set by hand.

    Returns:
        (H, W, 3) float32, 1 is diffuse white.
    """
    average = None if camera.metering is None else camera.metering.average(image)
    return (np.asarray(image, np.float64) * camera.exposure_scale(average)).astype(np.float32)
