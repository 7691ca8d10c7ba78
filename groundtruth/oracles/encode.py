"""`encode`: IEC 61966-2-1, display-linear to code values, by colour-science; input is clipped to 0…1 first."""

import warnings

import numpy as np

TERM = "encode"


def evaluate(image: np.ndarray) -> np.ndarray:
    """Code values 0…1, not quantised, of display-linear light: (…) float32."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # colour-science speaks of plotting libraries that are not there
        from colour.models import eotf_inverse_sRGB
    return np.asarray(eotf_inverse_sRGB(np.clip(np.asarray(image, np.float64), 0.0, 1.0)), np.float32)
