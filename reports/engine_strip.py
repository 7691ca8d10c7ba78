"""Every engine's picture beside its FLIP map, all at one scale, small enough to be looked at together."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from lightmeter.reports.candidate_words import is_ours, pair_name
from lightmeter.reports.display_curve import DisplayCurve, srgb_curve
from lightmeter.reports.engine_plot import engine_mark
from lightmeter.reports.heatmap import MASKED, colour_map, colourise
from lightmeter.reports.pictures import Pair, Space
from lightmeter.reports.results import Candidate
from lightmeter.reports.shown_names import short_name
from lightmeter.reports.significant import show_value
from lightmeter.reports.thumbnails import png_uri

Mask = npt.NDArray[np.bool_] | None

SIDE = 288
_MAP = "flip"
_COLOURS = "magma"
NOT_FINITE = (255, 0, 255)
"""As the viewer shows such a pixel of a picture."""


def engine_strip(
    candidates: Sequence[Candidate], pairs: Sequence[Pair], curve: DisplayCurve | None
) -> dict[str, Any] | None:
    """The truth, then each engine that has a pair; None where none has.

    No picture is brightened on its own, no map has a range of its own, and all are masked as one of them is, since all
    are measured over the same pixels: so they can be held side by side.
    """
    named = {pair.name: pair for pair in pairs}
    shown = [(place, one, named[pair_name(one)]) for place, one in enumerate(candidates) if pair_name(one) in named]
    if not shown:
        return None
    first = shown[0][2]
    mask = next((pair.mask for _, _, pair in shown if pair.mask is not None), None)
    return {
        "truth": _picture_uri(first.truth, first.space, None, curve),
        "bar": png_uri(np.ascontiguousarray(colour_map(_COLOURS).rgb[None, :, :])),
        "masked": mask is not None and not mask.all(),
        "engines": [
            {
                "name": short_name(one.name),
                "ours": is_ours(one),
                "mark": engine_mark(place, one),
                "pair": pair.name,
                "picture": _picture_uri(pair.tested, pair.space, mask, curve),
                "map": _map_uri(pair, mask),
                "flip": show_value(one.metrics[_MAP]) if _MAP in one.metrics else "",
            }
            for place, one, pair in shown
        ],
    }


def _picture_uri(image: npt.NDArray[np.float32], space: Space, mask: Mask, curve: DisplayCurve | None) -> str:
    """A picture through the frame's display transform; sRGB where there is none."""
    bad = np.any(~np.isfinite(image), axis=2, keepdims=True)
    finite = np.where(bad, 0.0, image.astype(np.float64))
    display = finite if space == "display" else (curve or srgb_curve()).apply(finite)
    small = reduced(np.where(bad, np.nan, np.clip(display, 0, 1)), mask)
    picture = np.round(255 * np.nan_to_num(small)).astype(np.uint8)
    picture[~np.isfinite(small).all(axis=2)] = NOT_FINITE
    judged = _judged(mask)
    if judged is not None:
        picture[~judged] = MASKED
    return png_uri(picture)


def _map_uri(pair: Pair, mask: Mask) -> str:
    """The FLIP map in the viewer's colours, 0 to 1; "" where the pair has none."""
    values = next((error.values for error in pair.errors if error.name == _MAP), None)
    if values is None:
        return ""
    small = reduced(values[..., None].astype(np.float64), mask)[..., 0]
    return png_uri(colourise(small, colour_map(_COLOURS), 0.0, 1.0, _judged(mask)))


def reduced(image: npt.NDArray[np.float64], mask: Mask, side: int = SIDE) -> npt.NDArray[np.float64]:
    """`image` (H, W, C) with neither side above `side`: means over squares of pixels, of those that `mask` keeps.

    A mean over a pixel that is not finite is not finite: the pixel is not lost. A square without any kept pixel is 0.
    """
    step = _step(image.shape, side)
    kept = np.ones(image.shape[:2], bool) if mask is None else mask
    sums = _summed(np.where(kept[..., None], image, 0.0), step)
    return sums / np.maximum(1, _summed(kept[..., None].astype(np.float64), step))


def _judged(mask: Mask) -> npt.NDArray[np.bool_] | None:
    """Which of the squares hold a pixel that is judged."""
    if mask is None:
        return None
    return _summed(mask[..., None].astype(np.float64), _step(mask.shape, SIDE))[..., 0] > 0


def _step(shape: Sequence[int], side: int) -> int:
    return -(-max(shape[:2]) // side)


def _summed(image: npt.NDArray[np.float64], step: int) -> npt.NDArray[np.float64]:
    """Sums over step × step pixels; fewer at the right and bottom edges."""
    height, width = image.shape[:2]
    sums = np.add.reduceat(image, np.arange(0, height, step), axis=0)
    return np.add.reduceat(sums, np.arange(0, width, step), axis=1)
