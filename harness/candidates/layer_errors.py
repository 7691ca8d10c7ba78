"""How wrong each layer is that an engine handed in, against its oracle at the same points."""

from collections.abc import Iterator

import numpy as np

from lightmeter.candidates.judging import Judged
from lightmeter.candidates.layer_buffers import Centres, contributions, is_term
from lightmeter.measuring import Question
from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.results import LayerError
from lightmeter.sides import Sides

TERM_METRICS = ("rmse", "nrmse", "relative_bias", "flip")


def layer_sides(judged: Judged, centres: Centres) -> Iterator[tuple[str, Sides]]:
    """Every layer that is a term, with both sides of it."""
    for name in judged.handed.layers:
        if is_term(name, judged.handed):
            both = [contributions(judged.handed, name, exact) for exact in centres.exact]
            tested, truth = ([np.asarray(pair[i], np.float32) for pair in both] for i in (0, 1))
            yield name, Sides(tested, truth)


def layer_question(sides: Sides, mask: np.ndarray | None) -> Question:
    """What is asked of a term's layer."""
    return Question(TERM_METRICS, sides, mask=mask)


def geometry_errors(judged: Judged, centres: Centres) -> tuple[LayerError, ...]:
    """Layers of the surface itself: normals in degrees, depth and position in metres, where both see a surface."""
    found = []
    for name in ("normal", "depth", "position"):
        if name not in judged.handed.layers:
            continue
        values = judged.handed.layers[name][1].astype(np.float64)
        errors = _GEOMETRY[name](values, centres)
        there = centres.points.hit[0] & np.isfinite(errors)
        there &= judged.mask if judged.mask is not None else True
        found.append(LayerError(name, "surface", _summary(errors[there], _UNITS[name]), int(there.sum())))
    return tuple(found)


def _angles(normals: np.ndarray, centres: Centres) -> np.ndarray:
    """(H, W) degrees between unit normals, by half the chord: exact for small angles; NaN where the layer has none."""
    length = np.linalg.norm(normals, axis=2, keepdims=True)
    unit = np.divide(normals, length, out=np.full_like(normals, np.nan), where=length > 0)
    chord = np.linalg.norm(unit - centres.points.normal[0], axis=2)
    return np.degrees(2 * np.arcsin(np.clip(chord / 2, 0, 1)))


def _depths(depth: np.ndarray, centres: Centres) -> np.ndarray:
    """(H, W) metres; NaN where the layer is empty."""
    return np.abs(np.where(depth[..., 0] > 0, depth[..., 0], np.nan) - centres.depth)


def _positions(position: np.ndarray, centres: Centres) -> np.ndarray:
    """(H, W) metres."""
    return np.linalg.norm(position - centres.points.position[0], axis=2)


_GEOMETRY = {"normal": _angles, "depth": _depths, "position": _positions}
_UNITS = {"normal": "°", "depth": "m", "position": "m"}


def _summary(errors: np.ndarray, unit: str) -> dict[str, Measurement]:
    """Root mean square, median and 99th percentile; silhouettes that fall to either side live in the last one."""
    if not errors.size:
        return {}
    how = f"over {errors.size} pixels, without noise"
    values = {"rmse": float(np.sqrt(np.mean(errors**2)))}
    values |= {name: float(np.percentile(errors, p)) for name, p in (("p50", 50), ("p99", 99))}
    return {name: Measurement(value, unit=unit, how=how) for name, value in values.items()}
