"""`tone`: the reference display transform, scene-linear to display-linear.

The ACES SDR view for an sRGB display, by OpenColorIO: of ACES 1.0, from its built-in ACES 1.3 config, what real-time
fits such as Narkowicz's and Hill's imitate; or of ACES 2.0, where the camera says so. The sRGB encoding that the view
ends with is taken off again by OpenColorIO's own inverse (that is the term `encode`), and the result is clipped to 0…1,
as a display does: the view of ACES 1.0 itself reaches 1.09 for very bright light.
"""

from functools import cache

import numpy as np

TERM = "tone"

CONFIG = "cg-config-v2.2.0_aces-v1.3_ocio-v2.4"
SOURCE = "Linear Rec.709 (sRGB)"
DISPLAY = "sRGB - Display"
VIEW = "ACES 1.0 - SDR Video"
VIEWS = {
    "aces-1": (CONFIG, VIEW),
    "aces-2": ("cg-config-v5.0.0_aces-v2.1_ocio-v2.6", "ACES 2.0 - SDR 100 nits (Rec.709)"),
}
"""OpenColorIO's built-in config and its view, by the camera's word for it (`Camera.view`)."""


def evaluate(image: np.ndarray, view: str = "aces-1") -> np.ndarray:
    """Display-linear Rec. 709, 0…1, of scene-linear Rec. 709.

    Args:
        image: (…, 3), exposure applied, 1 is diffuse white.
        view: of VIEWS.

    Returns:
        (…, 3) float32; not a number wherever the input is not finite.
    """
    out = np.array(image, dtype=np.float32, order="C")
    if out.ndim == 0 or out.shape[-1] != 3:
        raise ValueError(f"expected an array of shape (…, 3), got {out.shape}")
    wrong = ~np.isfinite(out).all(axis=-1)
    flat = out.reshape(-1, 3)
    if len(flat):
        _processor(view).applyRGB(flat)
    out = np.clip(flat.reshape(out.shape), 0.0, 1.0)
    out[wrong] = np.nan
    return out


@cache
def _processor(view: str):
    """OpenColorIO's transform, without optimisations that trade exactness for speed."""
    import PyOpenColorIO

    name, of_display = VIEWS[view]
    config = PyOpenColorIO.Config.CreateFromBuiltinConfig(name)
    shown = PyOpenColorIO.DisplayViewTransform(src=SOURCE, display=DISPLAY, view=of_display)
    decode = PyOpenColorIO.ExponentWithLinearTransform(gamma=[2.4, 2.4, 2.4, 1.0], offset=[0.055, 0.055, 0.055, 0.0])
    chain = PyOpenColorIO.GroupTransform([shown, decode])
    return config.getProcessor(chain).getOptimizedCPUProcessor(PyOpenColorIO.OPTIMIZATION_LOSSLESS)
