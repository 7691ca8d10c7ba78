"""All pairs of a comparison in one layered OpenEXR file, for tev and other viewers.

Channel names follow OpenEXR's `layer.channel` convention: `frame.tested.R`, `frame.truth.G`,
`frame.error.flip`. A file holds one picture size; pairs of another size need a file of their own.
"""

import os
import re
from collections.abc import Iterable
from pathlib import Path

import numpy as np
import numpy.typing as npt

from lightmeter.reports.image_files import write_channels
from lightmeter.reports.pictures import Pair
from lightmeter.scenes.image_files.image_error import ImageError


def write_layers(path: str | os.PathLike[str], pairs: Iterable[Pair], metadata: dict[str, str] | None = None) -> Path:
    """Write tested, truth and every error map of each pair as layers of one file, in one step.

    The first pair's tested picture is also the unnamed layer (R, G, B), so that a viewer that knows no layers
    shows something.

    Raises:
        ImageError: no pairs, pairs of different sizes or of one name, or a file that cannot be written.
    """
    channels: dict[str, npt.NDArray[np.float32]] = {}
    first: Pair | None = None
    for pair in pairs:
        first = first or pair
        if pair.size != first.size:
            raise ImageError(
                "pairs of different sizes",
                where=path,
                expected=f"{first.size[0]}×{first.size[1]} as '{first.name}'",
                actual=f"{pair.size[0]}×{pair.size[1]} in '{pair.name}'",
            )
        layer = layer_name(pair.name)
        if f"{layer}.tested.R" in channels:
            raise ImageError("two pairs of one name", where=path, actual=f"'{pair.name}'")
        for what, image in (("tested", pair.tested), ("truth", pair.truth)):
            for index, channel in enumerate("RGB"):
                channels[f"{layer}.{what}.{channel}"] = image[..., index]
        for error in pair.errors:
            channels[f"{layer}.error.{layer_name(error.name)}"] = error.values
    if first is None:
        raise ImageError("no pairs", where=path, expected="at least one pair of pictures")
    channels |= {channel: first.tested[..., index] for index, channel in enumerate("RGB")}
    return write_channels(path, channels, metadata)


def layer_name(name: str) -> str:
    """`name` as a part of a channel's name: a dot would start another layer."""
    return re.sub(r"[^\w+-]+", "_", name) or "_"
