"""Small pictures of pairs for choosing among them."""

import base64
import io

import numpy as np
import numpy.typing as npt

from lightmeter.reports.display_curve import DisplayCurve, srgb_curve
from lightmeter.reports.pictures import Pair

SIDE = 112


def thumbnail(pair: Pair, curve: DisplayCurve | None = None) -> npt.NDArray[np.uint8]:
    """The tested picture, uint8 (h, w, 3), at most `SIDE` pixels wide or high.

    Dim buffers are brightened to be told apart: their 99th percentile is brought to 0.8 before the curve.
    """
    step = max(1, -(-max(pair.size) // (4 * SIDE)))
    image = np.nan_to_num(pair.tested[::step, ::step].astype(np.float64), nan=0.0, posinf=0.0, neginf=0.0)
    if pair.space == "display":
        shown = np.clip(image, 0, 1)
    else:
        bright = float(np.percentile(image, 99))
        gain = 0.8 / bright if 0 < bright < 0.2 else 1.0
        shown = (curve or srgb_curve()).apply(image * gain)
    return np.round(np.clip(shown, 0, 1) * 255).astype(np.uint8)


def data_uri(picture: npt.NDArray[np.uint8]) -> str:
    """A uint8 (h, w, 3) picture, scaled down to `SIDE`, as a JPEG in a data URI."""
    from PIL import Image

    image = Image.fromarray(np.ascontiguousarray(picture))
    image.thumbnail((SIDE, SIDE), Image.Resampling.BOX)
    buffer = io.BytesIO()
    image.save(buffer, "JPEG", quality=85)
    return "data:image/jpeg;base64," + base64.b64encode(buffer.getvalue()).decode("ascii")


def png_uri(picture: npt.NDArray[np.uint8]) -> str:
    """A uint8 (h, w, 3) picture, texel by texel, as a PNG in a data URI."""
    from PIL import Image

    buffer = io.BytesIO()
    Image.fromarray(picture).save(buffer, "PNG", compress_level=6)
    return "data:image/png;base64," + base64.b64encode(buffer.getvalue()).decode("ascii")
