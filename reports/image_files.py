"""OpenEXR files, written in one step."""

import os
from pathlib import Path

import numpy as np
import numpy.typing as npt

from lightmeter.reports.one_step import in_one_step
from lightmeter.scenes.image_files.image_error import ImageError


def write_exr(path: str | os.PathLike[str], image: npt.ArrayLike) -> Path:
    """Write float32 (H, W, 3) as an OpenEXR file with channels R, G, B, in one step."""
    pixels = np.asarray(image, np.float32)
    if pixels.ndim != 3 or pixels.shape[2] != 3 or pixels.size == 0:
        raise ImageError("cannot be written", where=path, expected="an array (H, W, 3)", actual=str(pixels.shape))
    return write_channels(path, {name: pixels[..., index] for index, name in enumerate("RGB")})


def write_channels(
    path: str | os.PathLike[str],
    channels: dict[str, npt.NDArray[np.float32]],
    metadata: dict[str, str] | None = None,
) -> Path:
    """Write float32 channels (H, W) of one size as an OpenEXR file (ZIP, linear Rec.709), in one step.

    `metadata` becomes text attributes of the header.
    """
    import OpenEXR

    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage, **(metadata or {})}
    planes = {name: np.ascontiguousarray(plane, dtype=np.float32) for name, plane in channels.items()}
    try:
        with in_one_step(path) as partial:
            OpenEXR.File(header, planes).write(str(partial))
    except RuntimeError as error:
        raise ImageError("cannot be written", where=path, actual=str(error)) from None
    return Path(path)
