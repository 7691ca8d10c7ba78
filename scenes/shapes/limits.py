"""The ranges of the shapes' parameters, and the check against them."""

import math

from lightmeter.scenes.errors import SceneError, shown

LENGTH = (1e-6, 1e6)
"""Metres: from a micrometre to a thousand kilometres, so that float32 areas neither vanish nor overflow."""

AROUND = (3, 1024)
"""Steps around an axis."""

ALONG = (1, 1024)
"""Steps along a straight side."""

RINGS = (2, 1024)
"""Steps from pole to pole of a sphere."""


def check_length(name: str, value: float) -> float:
    """`value` as a float, if it lies in `LENGTH`.

    Raises:
        SceneError: it does not, or it is no number.
    """
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise SceneError(f"{name} is no length", expected="a finite number", actual=shown(value))
    if not LENGTH[0] <= value <= LENGTH[1]:
        raise SceneError(
            f"{name} is out of range", expected=f"{LENGTH[0]:g} to {LENGTH[1]:g} metres", actual=f"{value:g}"
        )
    return float(value)


def check_steps(name: str, value: int, limits: tuple[int, int]) -> int:
    """`value`, if it is a whole number within `limits`.

    Raises:
        SceneError: it is not.
    """
    if isinstance(value, bool) or not isinstance(value, int) or not limits[0] <= value <= limits[1]:
        raise SceneError(
            f"{name} is out of range",
            expected=f"a whole number from {limits[0]} to {limits[1]}",
            actual=shown(value),
        )
    return value
