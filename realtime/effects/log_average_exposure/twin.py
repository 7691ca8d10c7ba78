"""Twin of the passes."""

import numpy as np

from lightmeter.scenes.metering import Metering
from lightmeter.scenes.optics.color import LUMINANCE

from ...effect import Knobs
from ...pictures.sampling import bilinear, centres


def exposure(image: np.ndarray, knobs: Knobs, metering: Metering) -> float:
    """The log₂ of the average luminance of an (H, W, 3) picture."""
    side = int(knobs["side"])
    return float(np.log2(np.maximum(bilinear(image, *centres(side, side)) @ LUMINANCE, metering.floor)).mean())


TWINS = ()
