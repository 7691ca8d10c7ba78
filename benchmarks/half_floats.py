"""From which roughness and which cosine up does a shading function keep 1 % and 10 % in half floats?

    python benchmarks/half_floats.py

In 99 of 100 directions, with every operation rounded; in brackets, with half-float inputs alone and float32 from there
on. The figures go to docs/stability.md.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

from collections.abc import Callable

import numpy as np
from rich.console import Console
from rich.table import Table

from lightmeter.realtime.device import Device
from lightmeter.realtime.glsl_on_device import FunctionOnDevice
from lightmeter.realtime.stress.half_floats import FunctionInHalfFloats
from lightmeter.realtime.stress.judging import HALF_NORMAL, exact_results
from lightmeter.realtime.stress.naming import Subject, subjects
from lightmeter.realtime.twin import direction

FUNCTIONS = (
    "lambert/lambert",
    "minnaert/minnaert",
    "oren_nayar/oren_nayar_full",
    "oren_nayar/oren_nayar_eon",
    "shared/sheen_lobe",
    "phong/phong",
    "blinn_phong/blinn_phong",
    "shared/coat_lobe",
    "shared/gltf_brdf",
)
ROUGHNESSES = np.geomspace(0.02, 1, 41)
COSINES = np.geomspace(1e-3, 0.99, 41)
STEEP, ROUGH = 0.2, 0.7
"""What a cosine is at least while roughness varies, and what roughness is while the light's cosine varies."""
LANES = 8192
WITHIN = 3.0
"""Half vectors up to this many α from the normal, as for D by itself."""
OF_DIRECTIONS = 0.99
TWO_DIGITS, ONE_DIGIT = 0.01, 0.1


def main() -> None:
    """Measure, print."""
    device, known = Device(), {subject.name: subject for subject in subjects()}
    table = Table(title="half floats keep … from up (half-float inputs alone)", title_justify="left")
    for column in ("function", "roughness, 1 %", "10 %", "n·l, 1 %", "10 %"):
        table.add_column(column)
    for name in FUNCTIONS:
        table.add_row(name, *row(device, known[name]))
    Console().print(table)


def row(device: Device, subject: Subject) -> list[str]:
    """A function's least roughness, where it has one, and least cosine."""
    rounded = FunctionInHalfFloats(device, subject.twin, subject.folder)
    between = FunctionOnDevice(device, subject.twin, subject.folder)

    def of_half_inputs(inputs: list[np.ndarray]) -> list[np.ndarray]:
        return between([x.astype(np.float16).astype(np.float64) for x in inputs])

    cells = []
    rough = any(argument.name in ("roughness", "spread_of_slopes") for argument in subject.twin.arguments)
    for values, draw in ((ROUGHNESSES, by_roughness), (COSINES, by_cosine)):
        if draw is by_roughness and not rough:
            cells += ["–"] * 2
            continue
        rounded_errors, input_errors = (
            np.array([lost(f, subject, draw(subject, x)) for x in values]) for f in (rounded, of_half_inputs)
        )
        cells += [
            f"{least(values, rounded_errors, kept)} ({least(values, input_errors, kept)})"
            for kept in (TWO_DIGITS, ONE_DIGIT)
        ]
    return cells


def by_roughness(subject: Subject, roughness: float) -> list[np.ndarray]:
    """Both cosines are at least STEEP; half vectors lie within the lobe."""
    rng = np.random.default_rng(0)
    n, v = direction(rng, LANES), direction(rng, LANES)
    aside = np.cross(n, direction(rng, LANES), axis=0)
    h = n + aside / np.linalg.norm(aside, axis=0) * np.tan(np.minimum(roughness**2 * WITHIN, 1) * rng.random(LANES))
    h /= np.linalg.norm(h, axis=0)
    light = 2 * np.sum(v * h, axis=0) * h - v
    seen = (np.sum(n * v, axis=0) > STEEP) & (np.sum(n * light, axis=0) > STEEP)
    return arranged(subject, rng, roughness, *(x[:, seen] for x in (n, v, light)))


def by_cosine(subject: Subject, cosine: float) -> list[np.ndarray]:
    """Seen from a cosine of at least STEEP, on a rough surface."""
    rng = np.random.default_rng(0)
    n, v, aside = (direction(rng, LANES) for _ in range(3))
    aside = np.cross(n, aside, axis=0)
    light = cosine * n + np.sqrt(1 - cosine**2) * aside / np.linalg.norm(aside, axis=0)
    seen = np.sum(n * v, axis=0) > STEEP
    return arranged(subject, rng, ROUGH, *(x[:, seen] for x in (n, v, light)))


def arranged(subject: Subject, rng, roughness: float, n, v, light) -> list[np.ndarray]:
    """The function's arguments, the others as they are declared; as float32 holds them."""
    size = n.shape[1]
    fixed = {
        "n": n,
        "v": v,
        "l": light,
        "roughness": np.full(size, roughness),
        "spread_of_slopes": np.full(size, roughness),
    }
    found = []
    for argument in subject.twin.arguments:
        x = fixed.get(argument.name)
        x = argument.draw(rng, size) if x is None else x
        found.append(np.reshape(x, (argument.size, size)).astype(np.float32).astype(np.float64))
    return found


def lost(function: Callable, subject: Subject, inputs: list[np.ndarray]) -> float:
    """The relative error that all but one in a hundred directions stay below."""
    exact, got = exact_results(subject.twin, inputs)[0], function(inputs)[0]
    with np.errstate(invalid="ignore"):
        error = np.abs(got - exact).max(axis=0) / np.maximum(np.abs(exact).max(axis=0), HALF_NORMAL)
    return float(np.quantile(np.where(np.isfinite(error), error, np.inf), OF_DIRECTIONS, method="higher"))


def least(values: np.ndarray, errors: np.ndarray, kept: float) -> str:
    """From which value up the error stays below what is to be kept."""
    broken = np.flatnonzero(~(errors < kept))
    start = broken[-1] + 1 if len(broken) else 0
    return "nowhere" if start == len(values) else f"{values[start]:.2g}"


if __name__ == "__main__":
    main()
