"""Texels that hold no quantity: one of them makes a filtered texture, and then an image, not finite."""

import numpy as np

from lightmeter.scenes.errors import SceneError


def check_texels(texels: np.ndarray, name: str) -> None:
    """Checks that texels are finite and not negative; bytes always are.

    Args:
        texels: (H, W, C) uint8 or float32.
        name: of the image, for the message.

    Raises:
        SceneError: there is a NaN, an infinity or a negative value, or no texel at all; says how many, and where the
            first is.
    """
    if texels.size == 0:
        raise SceneError("the image has no texels", where=name, actual=" × ".join(map(str, texels.shape)))
    if texels.dtype == np.uint8 or (np.isfinite(texels).all() and texels.min() >= 0):
        return
    kinds = {
        "NaN": np.isnan(texels),
        "+inf": np.isposinf(texels),
        "-inf": np.isneginf(texels),
        "below 0": np.isfinite(texels) & (texels < 0),
    }
    row, column, channel = np.argwhere(np.logical_or.reduce(list(kinds.values())))[0]
    raise SceneError(
        "the image has texels that are no colour",
        where=name,
        expected="finite values of 0 or more",
        actual=", ".join(f"{np.count_nonzero(bad)} {kind}" for kind, bad in kinds.items() if bad.any())
        + f", the first in row {row}, column {column}, channel {channel}",
        remedy="mend the image, or replace those texels",
    )
