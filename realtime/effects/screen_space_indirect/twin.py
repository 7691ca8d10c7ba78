"""Float64 twins of arcs.glsl."""

import numpy as np

from ...twin import Argument, Twin, uniform


def arc(h: np.ndarray, gamma: np.ndarray) -> np.ndarray:
    """∫₀ʰ cos(θ − γ)·sin θ dθ by Gauss and Legendre with 24 nodes; for h below 0 both sin θ and dθ are."""
    nodes, weights = np.polynomial.legendre.leggauss(24)
    angles = h * (nodes[:, None] + 1) / 2
    return np.sum(weights[:, None] * np.cos(angles - gamma) * np.sin(angles), axis=0) * h / 2


def step_share(step: np.ndarray, count: np.ndarray) -> np.ndarray:
    """The square of the step's share."""
    return (step / count) ** 2


def edge_distance(place: np.ndarray, way: np.ndarray, size: np.ndarray) -> np.ndarray:
    """To the nearer of the two edges ahead."""
    room = np.where(way >= 0, size - place, place)
    return np.min(room / np.maximum(np.abs(way), 1e-6), axis=0)


def inside(rng: np.random.Generator, inputs: list[np.ndarray]) -> list[np.ndarray]:
    """The place is a share of the size; the way has the length 1."""
    place, way, size = inputs
    return [place * size, way / np.linalg.norm(way, axis=0), size]


def way_signs(_place: np.ndarray, way: np.ndarray, _size: np.ndarray):
    """Which edge is ahead."""
    return [(component, np.ones_like(component)) for component in way]


TWINS = (
    Twin(
        "arcs.glsl",
        "arc",
        "float",
        (
            Argument("h", "float", uniform(-np.pi, np.pi), (0.0, 1.5)),
            Argument("gamma", "float", uniform(-np.pi / 2, np.pi / 2), (0.0,)),
        ),
        arc,
        roundings=8,
        why="2h − γ; the cosines and the sine (3), products and sums (4)",
        cancels=2.0,
    ),
    Twin(
        "arcs.glsl",
        "step_share",
        "float",
        (Argument("step", "float", uniform(0.0, 64.0)), Argument("count", "float", uniform(1.0, 64.0))),
        step_share,
        roundings=3.5,
        why="the division (2.5) and the square",
    ),
    Twin(
        "arcs.glsl",
        "edge_distance",
        "float",
        (
            Argument("place", "vec2", uniform(0.01, 0.99, 2)),
            Argument("way", "vec2", uniform(-1.0, 1.0, 2)),
            Argument("size", "vec2", uniform(16.0, 2048.0, 2)),
        ),
        edge_distance,
        roundings=1 + 2 + 2.5,
        why="the difference, mix (2), the division (2.5)",
        guards=("1e-6",),
        arrange=inside,
        signs=way_signs,
    ),
)
