"""Single channels of an OpenEXR file, as float32."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt

from lightmeter.scenes.image_files.exr_header import check_exr
from lightmeter.scenes.image_files.image_error import ImageError
from lightmeter.scenes.image_files.native_messages import native_messages
from lightmeter.scenes.image_files.size_claims import MAX_PIXELS


def channel_names(path: Path, max_pixels: int = MAX_PIXELS) -> tuple[str, ...]:
    """The names of all channels of all parts.

    Raises:
        ImageError: no OpenEXR file, or a header that is not sound.
    """
    return tuple(name for part in check_exr(path, max_pixels) for name in part.channels)


def read_planes(path: Path, names: Sequence[str], max_pixels: int = MAX_PIXELS) -> list[npt.NDArray[np.float32]]:
    """The channels of these names, (H, W) each, of one part of the file.

    Raises:
        ImageError: no part has them all, or its pixels do not decode.
    """
    check_exr(path, max_pixels)
    import OpenEXR

    complaint = ""
    with native_messages() as said:
        try:
            with OpenEXR.File(str(path), separate_channels=True) as file:
                # A part whose pixels do not decode is left out of the list, with a line on standard error.
                for part in file.parts:
                    if all(name in part.channels for name in names):
                        return [np.asarray(part.channels[name].pixels, np.float32) for name in names]
        except (RuntimeError, ValueError, TypeError, KeyError, MemoryError) as error:
            complaint = str(error)
        complaint = complaint or said()
    lines = [line.strip() for line in complaint.splitlines() if line.strip()]
    raise ImageError(
        "damaged or cut short",
        where=path,
        actual=lines[-1].removeprefix("Warning: ")[:200] if lines else "pixels that do not decode",
        remedy="Write or copy the file again",
    )
