"""Error maps as pictures: a perceptually uniform colour map, a colour bar with ticks and unit, as PNG.

magma for magnitudes and vik for signed errors keep their order for colour-blind eyes and in grey print.
The tables and their sources are in `colour_maps.json`.
"""

import json
import math
import os
from dataclasses import dataclass
from functools import cache
from importlib import resources
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from lightmeter.reports.one_step import in_one_step
from lightmeter.reports.pictures import ErrorMap

if TYPE_CHECKING:
    from PIL import Image

MASKED = (128, 128, 128)


@dataclass(frozen=True, eq=False)
class ColourMap:
    """256 colours from low to high.

    Attributes:
        rgb: uint8 (256, 3), sRGB code values.
        nonfinite: the colour of a pixel that is not finite; it is not on the map.
        source: whose map it is, and its licence.
    """

    name: str
    rgb: npt.NDArray[np.uint8]
    nonfinite: tuple[int, int, int]
    source: str


@cache
def colour_map(name: str) -> ColourMap:
    """The map called `name`: "magma", "viridis" or "vik".

    Raises:
        ValueError: a name that is not there.
    """
    table = json.loads(resources.files("lightmeter.reports").joinpath("colour_maps.json").read_text(encoding="utf-8"))
    if name not in table:
        raise ValueError(f"colour map '{name}': expected one of {', '.join(table)}")
    entry = table[name]
    rgb = np.frombuffer(bytes.fromhex(entry["rgb"]), np.uint8).reshape(256, 3)
    red, green, blue = bytes.fromhex(entry["nonfinite"])
    return ColourMap(name, rgb, (red, green, blue), entry["source"])


def map_for(error: ErrorMap) -> ColourMap:
    """The colour map that suits the error map's scale."""
    return colour_map("vik" if error.scale == "signed" else "magma")


def colourise(
    values: npt.NDArray[np.floating],
    colours: ColourMap,
    low: float,
    high: float,
    mask: npt.NDArray[np.bool_] | None = None,
) -> npt.NDArray[np.uint8]:
    """`values` (H, W) as uint8 (H, W, 3): `low` and below is the first colour, `high` and above the last.

    Pixels that are not finite get the map's own colour for them; pixels where `mask` is False are grey.
    """
    position = (values.astype(np.float64) - low) / (high - low)
    finite = np.isfinite(values)
    steps = np.clip(np.floor(np.where(finite, position, 0.0) * 256.0), 0, 255).astype(np.uint8)
    picture = colours.rgb[steps]
    picture[~finite] = colours.nonfinite
    if mask is not None:
        picture[~mask] = MASKED
    return picture


def ticks(low: float, high: float, about: int = 5) -> list[float]:
    """Round values (1, 2 or 5 times a power of ten apart) within [low, high], about as many as asked for."""
    if not (math.isfinite(low) and math.isfinite(high) and high > low):
        return []
    raw = (high - low) / max(1, about)
    scale = 10.0 ** math.floor(math.log10(raw))
    step = next(factor * scale for factor in (1, 2, 5, 10) if factor * scale >= raw * (1 - 1e-9))
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [index * step for index in range(first, last + 1)]


def draw_heatmap(
    error: ErrorMap,
    title: str = "",
    *,
    limits: tuple[float, float] | None = None,
    mask: npt.NDArray[np.bool_] | None = None,
) -> "Image.Image":
    """The error map at its own resolution with title above and colour bar below, as a Pillow RGB picture.

    Small maps are enlarged by a whole factor, so that the text has room and no pixel is blended.
    `limits` replaces the range that the map's scale would choose.
    """
    from PIL import Image

    low, high = limits or error.range()
    colours = map_for(error)
    pixels = colourise(error.values, colours, low, high, mask)
    factor = max(1, math.ceil(320 / pixels.shape[1]))
    pixels = np.repeat(np.repeat(pixels, factor, axis=0), factor, axis=1)
    height, width = pixels.shape[:2]
    sheet = Image.new("RGB", (width + 2 * _MARGIN, height + _TITLE + _BAR + _MARGIN), _PAPER)
    sheet.paste(Image.fromarray(pixels), (_MARGIN, _TITLE))
    _ring_nonfinite(sheet, error, factor)
    _write_title(sheet, title or error.title)
    _draw_bar(sheet, error, colours, (low, high), _TITLE + height + 14)
    return sheet


def write_heatmap(
    path: str | os.PathLike[str],
    error: ErrorMap,
    title: str = "",
    *,
    limits: tuple[float, float] | None = None,
    mask: npt.NDArray[np.bool_] | None = None,
) -> Path:
    """Write `draw_heatmap(…)` as PNG, in one step."""
    sheet = draw_heatmap(error, title, limits=limits, mask=mask)
    with in_one_step(path) as partial:
        sheet.save(partial, format="PNG", compress_level=2)
    return Path(path)


_PAPER = (255, 255, 255)
_INK = (32, 33, 36)
_MARGIN = 16
_TITLE = 40
_BAR = 62
_BAR_HEIGHT = 14
_RINGS = 64

# Pillow's own font, the only one that is on every machine, has little beyond ASCII.
_SPELLED = str.maketrans({"²": "^2", "³": "^3", "×": "x", "·": ".", "Δ": "Delta ", "−": "-", "–": "-", "…": "..."})


def _spelled(text: str) -> str:
    return text.translate(_SPELLED).encode("ascii", "replace").decode("ascii")


def _font(size: int):
    from PIL import ImageFont

    return ImageFont.load_default(size)


def _ring_nonfinite(sheet: "Image.Image", error: ErrorMap, factor: int) -> None:
    """A ring around each of the first pixels that are not finite: one pixel alone would not be seen."""
    from PIL import ImageDraw

    draw = ImageDraw.Draw(sheet)
    rows, columns = np.nonzero(~np.isfinite(error.values))
    for row, column in zip(rows[:_RINGS], columns[:_RINGS], strict=True):
        x, y = _MARGIN + (column + 0.5) * factor, _TITLE + (row + 0.5) * factor
        for radius, colour in ((factor * 0.75 + 6, (0, 0, 0)), (factor * 0.75 + 5, (255, 255, 255))):
            draw.ellipse([x - radius, y - radius, x + radius, y + radius], outline=colour)


def _write_title(sheet: "Image.Image", title: str) -> None:
    from PIL import ImageDraw

    room = sheet.width - 2 * _MARGIN
    font = _font(16)
    shown = whole = _spelled(title)
    while whole and font.getlength(shown) > room:
        whole = whole[:-1]
        shown = whole + "..."
    ImageDraw.Draw(sheet).text((_MARGIN, _TITLE // 2), shown, fill=_INK, font=font, anchor="lm")


def _draw_bar(sheet: "Image.Image", error: ErrorMap, colours: ColourMap, limits: tuple[float, float], top: int) -> None:
    """Colour bar with ticks and unit, and beside the unit a swatch for pixels that are not finite."""
    from PIL import Image, ImageDraw

    low, high = limits
    draw = ImageDraw.Draw(sheet)
    width = sheet.width - 2 * _MARGIN
    steps = (np.arange(width) * 256 // width).astype(np.uint8)
    strip = np.broadcast_to(colours.rgb[steps], (_BAR_HEIGHT, width, 3))
    sheet.paste(Image.fromarray(np.ascontiguousarray(strip)), (_MARGIN, top))
    font = _font(12)
    for value in ticks(low, high, 4 if width < 400 else 6):
        x = _MARGIN + (value - low) / (high - low) * (width - 1)
        draw.line([(x, top + _BAR_HEIGHT), (x, top + _BAR_HEIGHT + 4)], fill=_INK)
        anchor = "lt" if x < _MARGIN + 14 else "rt" if x > _MARGIN + width - 14 else "mt"
        draw.text((x, top + _BAR_HEIGHT + 6), f"{value:.4g}", fill=_INK, font=font, anchor=anchor)
    below = top + _BAR_HEIGHT + 30
    draw.text((_MARGIN, below), _spelled(error.unit) or "no unit", fill=_INK, font=font, anchor="lm")
    bad = int(np.count_nonzero(~np.isfinite(error.values)))
    if bad:
        note = f"{bad} not finite"
        right = sheet.width - _MARGIN
        draw.text((right, below), note, fill=_INK, font=font, anchor="rm")
        left = right - font.getlength(note) - 18
        draw.rectangle([left, below - 6, left + 12, below + 6], fill=colours.nonfinite, outline=_INK)
