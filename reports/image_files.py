"""OpenEXR files, written in one step."""

import os
from pathlib import Path

import numpy as np
import numpy.typing as npt

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

    A reader sees the old file or the whole new one. `metadata` becomes text attributes of the header.
    """
    import OpenEXR

    target = Path(path)
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage, **(metadata or {})}
    planes = {name: np.ascontiguousarray(plane, dtype=np.float32) for name, plane in channels.items()}
    partial = target.with_name(f".{target.name}.{os.getpid()}.part.exr")
    try:
        OpenEXR.File(header, planes).write(str(partial))
        partial.replace(target)
    except (RuntimeError, OSError) as error:
        raise ImageError("cannot be written", where=path, actual=str(error)) from None
    finally:
        partial.unlink(missing_ok=True)
    return target
