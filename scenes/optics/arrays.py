"""The few array operations the optics need, for NumPy and for Dr.Jit.

Dr.Jit is never imported here (only `groundtruth` may): who holds a Dr.Jit array has loaded it already.
"""

import sys
from typing import Any

import numpy as np

Array = Any
"""A NumPy array or scalar, or a Dr.Jit array: components first."""


def _is_drjit(*values: Array) -> bool:
    return any(type(v).__module__.startswith(("drjit", "mitsuba")) for v in values)


def _drjit():
    return sys.modules["drjit"]


def sqrt(x: Array) -> Array:
    """√x."""
    return _drjit().sqrt(x) if _is_drjit(x) else np.sqrt(x)


def maximum(a: Array, b: Array) -> Array:
    """The larger of the two, element by element."""
    return _drjit().maximum(a, b) if _is_drjit(a, b) else np.maximum(a, b)


def minimum(a: Array, b: Array) -> Array:
    """The smaller of the two, element by element."""
    return _drjit().minimum(a, b) if _is_drjit(a, b) else np.minimum(a, b)


def clip(x: Array, low: Array, high: Array) -> Array:
    """x held within [low, high]."""
    return minimum(maximum(x, low), high)


def where(condition: Array, a: Array, b: Array) -> Array:
    """a where the condition holds, else b."""
    return _drjit().select(condition, a, b) if _is_drjit(condition, a, b) else np.where(condition, a, b)


def floor(x: Array) -> Array:
    """The largest whole number not above x."""
    return _drjit().floor(x) if _is_drjit(x) else np.floor(x)


def power(x: Array, exponent: float) -> Array:
    """x to a constant power, x ≥ 0."""
    return _drjit().power(x, exponent) if _is_drjit(x) else np.power(x, exponent)


def exp(x: Array) -> Array:
    """eˣ."""
    return _drjit().exp(x) if _is_drjit(x) else np.exp(x)


def log(x: Array) -> Array:
    """ln x, x > 0."""
    return _drjit().log(x) if _is_drjit(x) else np.log(x)


def take(table: Array, index: Array) -> Array:
    """The table's elements, (N,), at whole numbers within it."""
    if _is_drjit(table):
        whole = _drjit().uint32_array_t(type(table))
        return _drjit().gather(type(table), table, whole(index))
    return table[np.asarray(index).astype(np.intp)]


def arctan2(y: Array, x: Array) -> Array:
    """The angle of (x, y), radians."""
    return _drjit().atan2(y, x) if _is_drjit(y, x) else np.arctan2(y, x)


def sincos(x: Array) -> tuple[Array, Array]:
    """sin x and cos x."""
    return _drjit().sincos(x) if _is_drjit(x) else (np.sin(x), np.cos(x))


def cos(x: Array) -> Array:
    """cos x."""
    return _drjit().cos(x) if _is_drjit(x) else np.cos(x)


def dot(a: Array, b: Array) -> Array:
    """Scalar product over the components."""
    return _drjit().dot(a, b) if _is_drjit(a, b) else np.sum(np.multiply(a, b), axis=0)


def cross(a: Array, b: Array) -> Array:
    """Vector product."""
    return _drjit().cross(a, b) if _is_drjit(a, b) else np.cross(a, b, axis=0)


def normalize(v: Array) -> Array:
    """v / |v|; a zero vector gives a zero vector (not NaN)."""
    square = dot(v, v)
    return v * where(square > 0, 1 / sqrt(maximum(square, 1e-38)), 0 * square)


def mix(a: Array, b: Array, t: Array) -> Array:
    """(1 − t)·a + t·b."""
    return a + (b - a) * t
