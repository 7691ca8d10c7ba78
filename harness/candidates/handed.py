"""A candidate's frame as it was handed in: its pixels as light, its layers, and what it says of itself."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from lightmeter.candidates.candidate import TRANSFERS, Candidate, Transfer, Unsupported
from lightmeter.candidates.failure import CandidateError
from lightmeter.candidates.layer_names import LAYERS, Named, find_layers
from lightmeter.candidates.obtaining import Files
from lightmeter.candidates.side_file import SideFile, read_side_file
from lightmeter.reports.results import Timing
from lightmeter.scenes.image_files import exr_header, exr_planes
from lightmeter.scenes.image_files.image_error import ImageError
from lightmeter.scenes.image_files.reading import read_alpha, read_image
from lightmeter.scenes.optics.color import srgb_decode, srgb_encode

Display = Callable[[np.ndarray], np.ndarray]

MOST_NAMED = 4
"""Layers that a note lists."""

_PNG = b"\x89PNG\r\n\x1a\n"


@dataclass(frozen=True, eq=False)
class Handed:
    """One candidate's frame.

    Attributes:
        image: (H, W, 3) float32 scene-linear radiance before exposure, as the transfer says; not yet registered.
        alpha: (H, W), or None.
        layers: name to the layer and its values, (H, W, 3) or (H, W, 1).
        transfer: how the file's values were taken.
        display: what its pixels have been through, for a display image; None: scene-linear.
        time, time_how, time_whole: see `results.Candidate`.
        unsupported: by the command line, the configuration and the side file together.
    """

    candidate: Candidate
    image: np.ndarray
    alpha: np.ndarray | None
    layers: Mapping[str, tuple[Named, np.ndarray]]
    transfer: Transfer
    display: Display | None
    time: Timing | None
    time_how: str
    time_whole: bool
    unsupported: Unsupported
    engine: str = ""
    device: str = ""
    notes: tuple[str, ...] = field(default=())


def take(candidate: Candidate, files: Files, size: tuple[int, int], exposure: float, display: Display) -> Handed:
    """Read what a candidate left.

    Args:
        size: (width, height) that is expected.
        exposure: the scene camera's, in stops: what a display image has been exposed by.
        display: the frame's display transform, exposure included.

    Raises:
        CandidateError: a file is missing, damaged, of another size, or its encoding is not stated.
    """
    try:
        values = read_image(files.image, encoding="linear")
        alpha = read_alpha(files.image)
        layers, others = _layers(files.image)
    except ImageError as error:
        raise CandidateError(str(error)) from None
    said = read_side_file(files.side_file)
    width, height = size
    if values.shape[:2] != (height, width):
        raise CandidateError(
            f"{files.image}: expected {width}×{height} pixels, got {values.shape[1]}×{values.shape[0]}; "
            "render at the size asked for (--size says it)"
        )
    transfer = candidate.transfer or said.transfer or _own_transfer(files.image)
    stops = candidate.exposure if candidate.exposure is not None else said.exposure
    shown = _display(transfer, exposure if stops is None else stops, display)
    image = _light(values, transfer, stops or 0.0, shown, files.image)
    time, how, whole = _time(said, files.seconds)
    theirs = said.unsupported
    notes = [*said.notes]
    if others:
        more = f" and {len(others) - MOST_NAMED} more" if len(others) > MOST_NAMED else ""
        notes.append(f"Layers that have no documented name are not read: {', '.join(others[:MOST_NAMED])}{more}.")
    if shown is not None:
        notes.append(
            f"A display image ({TRANSFERS[transfer]}): only display metrics speak of it, with the truth put through "
            "the same transform."
        )
    return Handed(
        candidate,
        image,
        alpha,
        layers,
        transfer,
        shown,
        time,
        how,
        whole,
        candidate.unsupported | Unsupported(theirs.materials, theirs.objects, theirs.background),
        said.engine,
        said.device,
        tuple(notes),
    )


def _layers(path: Path) -> tuple[dict[str, tuple[Named, np.ndarray]], tuple[str, ...]]:
    """The documented layers of an OpenEXR file, and the names of others."""
    with path.open("rb") as file:
        if file.read(4) != exr_header.MAGIC:
            return {}, ()
    named, others = find_layers(exr_planes.channel_names(path))
    found = {}
    for layer in named:
        planes = np.stack(exr_planes.read_planes(path, layer.channels), axis=2)
        triple = LAYERS[layer.kind].values == 3 and planes.shape[2] == 1
        found[layer.name] = layer, np.repeat(planes, 3, axis=2) if triple else planes
    return found, others


def _own_transfer(path: Path) -> Transfer:
    """Scene-linear files need not say so; a display image must."""
    with path.open("rb") as file:
        if file.read(len(_PNG)) != _PNG:
            return "linear"
    choices = "; ".join(f"{name}: {meaning}" for name, meaning in TRANSFERS.items())
    raise CandidateError(f"{path}: a PNG holds display values: say how they were made with --transfer ({choices})")


def _display(transfer: Transfer, stops: float, display: Display) -> Display | None:
    """The transform from radiance to the values of a display image; None for a scene-linear one."""
    if transfer == "linear":
        return None
    if transfer == "display":
        return display
    encode = srgb_encode if transfer == "srgb" else _gamma_encode
    return lambda image: encode(np.clip(image * 2.0**stops, 0.0, 1.0)).astype(np.float32)


def _gamma_encode(image: np.ndarray) -> np.ndarray:
    return image ** (1 / 2.2)


def _light(values: np.ndarray, transfer: Transfer, stops: float, display: Display | None, path: Path) -> np.ndarray:
    """(H, W, 3) float32: the radiance that the file's values stand for."""
    if display is None:
        return values if stops == 0 else (values * np.float32(2.0**-stops)).astype(np.float32)
    finite = np.isfinite(values)
    codes = np.clip(np.where(finite, values, 0.0), 0.0, 1.0)
    if transfer == "srgb":
        light = srgb_decode(codes) * 2.0**-stops
    elif transfer == "gamma22":
        light = codes**2.2 * 2.0**-stops
    else:
        light = _undone(codes, display, path)
    return np.where(finite, light, np.nan).astype(np.float32)


def _undone(codes: np.ndarray, display: Display, path: Path) -> np.ndarray:
    """The radiance that the display transform shows as these codes; of a range that shows alike, the least.

    Raises:
        CandidateError: the transform mixes channels, so that a curve does not undo it.
    """
    stops = np.linspace(-24.0, 16.0, 1 << 14)
    grey = np.repeat((2.0**stops)[:, None], 3, axis=1)
    curve = display(np.vstack([np.zeros(3), grey])).astype(np.float64)
    radiance = np.concatenate([[0.0], 2.0**stops])
    light = np.empty(codes.shape)
    for channel in range(3):
        rising = np.maximum.accumulate(curve[:, channel])
        first = np.concatenate([[True], np.diff(rising) > 0])
        light[..., channel] = np.interp(codes[..., channel], rising[first], radiance[first])
    off = float(np.abs(display(light) - codes).max())
    # Half a code of 8 bits, and the interpolation between 14 bits of grey.
    if off > 1.0 / 255:
        raise CandidateError(
            f"{path}: the frame's display transform cannot be undone from its values (off by {off:.2g}); hand in a "
            "scene-linear image"
        )
    return light


def _time(said: SideFile, seconds: float | None) -> tuple[Timing | None, str, bool]:
    """The time, who measured it, and whether start-up is within."""
    if said.time is not None:
        return Timing(said.time.median, said.time.mad, said.time.frames), "reported by the engine", False
    if seconds is not None:
        return Timing(seconds * 1e3, 0.0, 1), "measured around the command, start-up and loading included", True
    return None, "", False
