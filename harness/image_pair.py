"""Two images on disk, made comparable.

PNG files are display images: sRGB code values. OpenEXR and Radiance HDR files are scene-linear. Where one of the two is
a display image, the other one becomes one too: exposed, clipped to 0…1, and put through the sRGB curve.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np

from lightmeter.failures import UsageError
from lightmeter.metrics.finite import find_non_finite
from lightmeter.scenes.image_files.reading import read_image
from lightmeter.scenes.optics.color import srgb_decode, srgb_encode

Transfer = Literal["srgb", "linear"]

_PNG = b"\x89PNG\r\n\x1a\n"


@dataclass(frozen=True, eq=False)
class ImageFile:
    """One image as it lies on disk.

    Attributes:
        values: (H, W, 3) float32 as stored: sRGB code values of a display image, else scene-linear.
        is_display: whether it is a display image.
    """

    path: Path
    values: np.ndarray
    is_display: bool

    @property
    def size(self) -> str:
        """ "512×512"."""
        return f"{self.values.shape[1]}×{self.values.shape[0]}"


@dataclass(frozen=True, eq=False)
class ImagePair:
    """Both images, each as light and as display values, (H, W, 3) float32; what is not finite is so in both.

    Attributes:
        tested, reference: light: scene-linear, or what the display values stand for.
        tested_shown, reference_shown: display values 0…1.
        space: "display" where one file at least is a display image.
        notes: what was done to the files, for the report.
    """

    names: tuple[str, str]
    tested: np.ndarray
    reference: np.ndarray
    tested_shown: np.ndarray
    reference_shown: np.ndarray
    space: Literal["scene-linear", "display"]
    exposure: float
    notes: tuple[str, ...]


def read(path: Path, transfer: Transfer | None = None, layer: str | None = None) -> ImageFile:
    """The image at `path`.

    Args:
        transfer: how its values are encoded; None: "srgb" for PNG, "linear" for EXR and HDR.
        layer: of an EXR file.

    Raises:
        ImageError: it is missing, damaged or no image.
    """
    values = read_image(path, encoding="linear", layer=layer)
    with path.open("rb") as file:
        is_png = file.read(len(_PNG)) == _PNG
    return ImageFile(path, values, is_png if transfer is None else transfer == "srgb")


def pair(tested: ImageFile, reference: ImageFile, exposure: float | None = None) -> ImagePair:
    """Both sides, comparable.

    Args:
        exposure: stops by which scene-linear images are brightened before they are shown.

    Raises:
        UsageError: the sizes differ, the reference has pixels that are not finite, or there is nothing to expose.
    """
    if tested.values.shape != reference.values.shape:
        raise UsageError(
            f"the images differ in size: {tested.path} is {tested.size}, {reference.path} is {reference.size}; "
            "render or resample one of them to the other's size"
        )
    bad = find_non_finite(reference.values)
    if bad:
        raise UsageError(
            f"{reference.path}: a reference must be finite everywhere, got {bad}; render it again, or exchange the two "
            "if this is the tested image"
        )
    files = (tested, reference)
    if exposure is not None and all(file.is_display for file in files):
        raise UsageError("--exposure: only a scene-linear image can be exposed, and both files are display images")
    stops = exposure or 0.0
    shown = [file.values if file.is_display else _shown(file.values, stops) for file in files]
    space = "display" if any(file.is_display for file in files) else "scene-linear"
    light = [
        srgb_decode(image) if space == "display" else file.values for image, file in zip(shown, files, strict=True)
    ]
    light = [np.asarray(image, np.float32) for image in light]
    return ImagePair(
        names=_names(tested.path, reference.path),
        tested=light[0],
        reference=light[1],
        tested_shown=shown[0],
        reference_shown=shown[1],
        space=space,
        exposure=stops,
        notes=(_how_compared(files, stops), *_negative(files)),
    )


def _shown(values: np.ndarray, stops: float) -> np.ndarray:
    """Display values of scene-linear ones; what is not finite stays a NaN, which clipping would hide."""
    finite = np.isfinite(values)
    with np.errstate(over="ignore"):  # what exceeds float32 is white or black as well
        exposed = np.clip(np.where(finite, values, 0.0) * 2.0**stops, 0.0, 1.0)
    return np.where(finite, srgb_encode(exposed), np.nan).astype(np.float32)


def _names(tested: Path, reference: Path) -> tuple[str, str]:
    """The files' names, with their folders where the names alone are the same."""
    return (tested.name, reference.name) if tested.name != reference.name else (str(tested), str(reference))


def _how_compared(files: tuple[ImageFile, ImageFile], stops: float) -> str:
    """One sentence on what the display metrics and the radiometric ones see."""
    made = (f"exposed by {stops:+g} stops, " if stops else "") + "clipped to 0…1 and encoded as sRGB"
    linear = [file.path.name for file in files if not file.is_display]
    if len(linear) == 2:
        return f"Both files are scene-linear; for the display metrics both are {made}."
    both = "Display metrics and PSNR are of the display values, the others of the light that these stand for."
    if linear:
        return f"{linear[0]} is scene-linear and the other file a display image, so it is {made}. {both}"
    return f"Both files are display images. {both}"


def _negative(files: tuple[ImageFile, ImageFile]) -> list[str]:
    """Where there are negative values, the rule for them."""
    notes = []
    for file in files:
        count = int(np.count_nonzero((file.values < 0).any(axis=2)))
        if count:
            pixels = "pixel" if count == 1 else "pixels"
            notes.append(
                f"{file.path.name} has {count} {pixels} with negative values, the lowest "
                f"{float(np.nanmin(file.values)):.3g}: display metrics, HDR-FLIP and ΔE ITP take them as 0, "
                "the others as they are."
            )
    return notes
