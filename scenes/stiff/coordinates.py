"""Extremes of place, size and depth: nothing that is seen changes, only the numbers that hold it."""

from dataclasses import replace

import numpy as np

from lightmeter.scenes.moving import moved, scaled
from lightmeter.scenes.stiff.case import StiffCase, room, viewer

THOUSAND = 1024.0
"""A thousand that float32 multiplies by without rounding: what differs then is an absolute length in the code."""


def _deep():
    return replace(room(), camera=viewer(near=1e-3, far=1e4))


CASES = {
    "plain": StiffCase("nothing: what the others are compared with", room),
    "depth-range": StiffCase("the camera's far plane is 10⁷ times its near one", _deep, like="plain"),
    "offset": StiffCase("10⁶ m from the origin", lambda: moved(room(), np.array([1e6, 0.0, 0.0])), like="plain"),
    "small": StiffCase(
        "a thousand times smaller", lambda: scaled(room(), 1 / THOUSAND), like="plain", scale=1 / THOUSAND
    ),
    "large": StiffCase("a thousand times larger", lambda: scaled(room(), THOUSAND), like="plain", scale=THOUSAND),
}
