"""Float64 twins of what is computed of virtual lights; what reads their textures is tested on scenes."""

import numpy as np

from lightmeter.scenes.optics.frames import basis

from ...shared_twins import color, stack, towards
from ...twin import Argument, Twin, logarithmic, uniform


def received_from(offset: np.ndarray, normal: np.ndarray, nearest: np.ndarray):
    """cos θ over the square of the distance or of the least one, and the direction to the light."""
    length = np.linalg.norm(offset, axis=0)
    direction = offset / np.where(length > 0, length, 1)
    distance = np.maximum(length, nearest)
    cosine = np.maximum(-np.sum(direction * normal, axis=0), 0)
    return cosine / np.where(distance > 0, distance, 1) ** 2, direction


def along_axes(offset: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """The offset in the normal's frame."""
    s, t = basis(normal, stack)
    return np.stack([np.sum(offset * axis, axis=0) for axis in (s, t, normal)])


def axial_depth(depth: np.ndarray, planes: np.ndarray) -> np.ndarray:
    """The inverse of a perspective depth: 1/z is linear in it, from 1/near to 1/far."""
    near, far = planes
    return 1 / ((1 - depth) / near + depth / far)


def between_planes(rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """A thousandth of the scene and the whole of it, as the effect has them."""
    depth, planes = inputs
    return [depth, planes[1] * np.array([[1e-3], [1.01]]) + 0 * rng.random(1)]


def alike(normal: np.ndarray, other: np.ndarray, between: np.ndarray) -> np.ndarray:
    """Normals within arccos 0.9, and the offset within arcsin 0.2 of the plane."""
    sine = np.abs(np.sum(normal * between, axis=0)) / np.linalg.norm(between, axis=0)
    return (np.sum(normal * other, axis=0) > 0.9) & (sine <= 0.2)


def alike_signs(normal: np.ndarray, other: np.ndarray, between: np.ndarray):
    """How far both comparisons are from turning."""
    off, square = np.sum(normal * between, axis=0), np.sum(between**2, axis=0)
    size = np.sum(np.abs(normal * between), axis=0)
    cosine = np.sum(normal * other, axis=0) - 0.9
    return [(cosine, np.sum(np.abs(normal * other), axis=0) + 0.9), (off**2 - 0.04 * square, 2 * size**2 + square)]


def nearly_alike(rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """Half of the lanes lie near both limits."""
    normal, other, between = inputs
    near = normal + 0.5 * rng.random(other.shape[1]) * other
    along = between - np.sum(between * normal, axis=0) * normal * rng.uniform(0.7, 1.0, other.shape[1])
    pick = rng.random(other.shape[1]) < 0.5
    return [normal, np.where(pick, near / np.linalg.norm(near, axis=0), other), np.where(pick, along, between)]


TWINS = (
    Twin(
        "patches.glsl",
        "received_from",
        "float",
        (
            Argument("offset", "vec3", uniform(-3, 3, 3), ((0.0, 0.0, 2.0), (0.0, 0.0, 0.0))),
            towards("normal"),
            Argument("nearest_distance", "float", logarithmic(1e-2, 3.0), (0.0, 1.0)),
            Argument("direction", "vec3", out=True),
        ),
        received_from,
        roundings=3 + 2 + 1 + 3 + 2.5,
        why="a square (3), inversesqrt (2) and the product; a scalar product (3), the division (2.5)",
    ),
    Twin(
        "patches.glsl",
        "along_axes",
        "vec3",
        (Argument("offset", "vec3", uniform(-3, 3, 3)), towards("n")),
        along_axes,
        roundings=1 + 2.5 + 4 + 3,
        why="1 + n.z, its inverse (2.5), the axes (4) and a scalar product (3)",
        cancels=6.0,
    ),
    Twin(
        "patches.glsl",
        "axial_depth",
        "float",
        (
            Argument("depth", "float", uniform(0.0, 1.0), (0.0, 1.0)),
            Argument("planes", "vec2", uniform(0.5, 50.0, 2)),
        ),
        axial_depth,
        roundings=1 + 3 + 2.5,
        why="near·far; far − near, its product and the difference; the division (2.5)",
        arrange=between_planes,
    ),
    Twin(
        "interleaved.glsl",
        "tint",
        "vec3",
        (color("base_color"),),
        lambda base_color: np.maximum(base_color, 0.01),
        roundings=1,
        why="the constant",
    ),
    Twin(
        "interleaved.glsl",
        "alike",
        "bool",
        (towards("normal"), towards("other_normal"), Argument("between", "vec3", uniform(-1.0, 1.0, 3))),
        alike,
        roundings=1,
        why="a truth value",
        arrange=nearly_alike,
        signs=alike_signs,
    ),
)
