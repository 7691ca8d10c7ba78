"""GGX in the textbook's form and in that of the cross product: digits kept against α, in float32 and in mediump."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from lightmeter.scenes.optics import microfacet

from ..device import Device
from ..glsl_on_device import FunctionOnDevice
from ..twin import Argument, Twin, direction, logarithmic
from .half_floats import FunctionInHalfFloats

FORMS = ("ggx_textbook", "ggx_cross")
ARITHMETIC = {
    "fp32": FunctionOnDevice,
    "mediump": FunctionInHalfFloats,
    "mediump, denormals flushed": partial(FunctionInHalfFloats, flush=True),
}
UP = np.array([[0.0], [0.0], [1.0]])
WITHIN = 3.0
"""Half vectors up to this many α from the normal: there D is down to a hundredth of its peak."""


@dataclass(frozen=True)
class Curve:
    """A form under an arithmetic.

    Attributes:
        alphas, digits: α and the digits kept at the worst of the directions.
        peak: the digits kept at the peak, n = h.
    """

    form: str
    arithmetic: str
    alphas: list[float]
    digits: list[float]
    peak: list[float]


def exact(n: np.ndarray, h: np.ndarray, alpha: np.ndarray) -> np.ndarray:
    """D in float64, of vectors that are units to float32's rounding: by the angle between them alone."""
    across, along = np.linalg.norm(np.cross(n, h, axis=0), axis=0), np.sum(n * h, axis=0)
    length = np.hypot(across, along)
    return microfacet.d_ggx(along / length, (across / length) ** 2, alpha)


def curves(device: Device, alphas: Sequence[float], lanes: int = 1024, seed: int = 0) -> list[Curve]:
    """Every form under every arithmetic."""
    rng = np.random.default_rng(seed)
    arguments = (
        Argument("n", "vec3", direction),
        Argument("h", "vec3", direction),
        Argument("alpha", "float", logarithmic(1e-6, 1)),
    )
    found = []
    for arithmetic, on_device in ARITHMETIC.items():
        for form in FORMS:
            twin = Twin("ggx_forms.glsl", form, "float", arguments, exact, 20, "")
            function = on_device(device, twin, Path(__file__).parent)
            kept, peak = [], []
            for alpha in alphas:
                n, h = _about(rng, alpha, lanes)
                kept.append(_digits(_errors(function, n, h, alpha)))
                peak.append(
                    _digits(_errors(function, n[:, :1] * 0 + [[0], [0], [1]], n[:, :1] * 0 + [[0], [0], [1]], alpha))
                )
            found.append(Curve(form, arithmetic, [float(a) for a in alphas], kept, peak))
    return found


def _about(rng: np.random.Generator, alpha: float, lanes: int) -> tuple[np.ndarray, np.ndarray]:
    """Normals, and half vectors about them within the lobe; as float32 holds them."""
    n = direction(rng, lanes)
    aside = np.cross(n, direction(rng, lanes), axis=0)
    aside /= np.linalg.norm(aside, axis=0)
    h = n + aside * alpha * rng.uniform(0, WITHIN, lanes)
    n, h = (v.astype(np.float32).astype(np.float64) for v in (n, h / np.linalg.norm(h, axis=0)))
    return n, h


def _errors(function: Callable, n: np.ndarray, h: np.ndarray, alpha: float) -> np.ndarray:
    a = np.full((1, n.shape[1]), np.float32(alpha), np.float64)
    got, true = function([n, h, a])[0][0], exact(n, h, a[0])
    with np.errstate(invalid="ignore"):
        return np.where(np.isfinite(got), np.abs(got - true) / true, np.inf)


def _digits(errors: np.ndarray) -> float:
    return float(np.clip(-np.log10(np.maximum(errors.max(), 1e-8)), 0, 7.2))


def least_alpha(curve: Curve, digits: float, of_peak: bool = False) -> float:
    """The smallest α of the curve from which up as many digits are kept; infinite where they never are."""
    kept = curve.peak if of_peak else curve.digits
    lost = [i for i, d in enumerate(kept) if d < digits]
    start = lost[-1] + 1 if lost else 0
    return curve.alphas[start] if start < len(kept) else float("inf")
