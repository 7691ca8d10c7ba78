"""Pairs of pictures, tested beside truth, with the error maps between them."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from lightmeter.reports.metric_words import error_phrase

Space = Literal["scene-linear", "display"]
Scale = Literal["unit", "magnitude", "signed"]


@dataclass(frozen=True, eq=False)
class ErrorMap:
    """How wrong each pixel is.

    Attributes:
        name: a short name, unique within its pair ("rms", "flip", "signed").
        title: as people read it ("FLIP", "RMS error").
        values: float32 (H, W), in `unit`; a pixel that is not finite is a failure and shown as one.
        unit: the unit as it is printed ("W/sr/m²"), "" for a pure number.
        scale: how the range is chosen when none is asked for:
            "unit" 0 to 1 (FLIP); "magnitude" 0 to the 99th percentile; "signed" symmetric about 0, to
            the 99th percentile of the absolute value, with a diverging colour map.
    """

    name: str
    title: str
    values: npt.NDArray[np.float32]
    unit: str = ""
    scale: Scale = "magnitude"

    def __post_init__(self) -> None:
        values = np.ascontiguousarray(self.values, dtype=np.float32)
        if values.ndim != 2 or values.size == 0:
            raise ValueError(f"error map '{self.name}': expected shape (H, W), found {values.shape}")
        object.__setattr__(self, "values", values)

    def range(self) -> tuple[float, float]:
        """Low and high end of the colour bar, in `unit`, by the rule of `scale`."""
        if self.scale == "unit":
            return 0.0, 1.0
        high = _robust_maximum(np.abs(self.values))
        return (-high, high) if self.scale == "signed" else (0.0, high)


@dataclass(frozen=True, eq=False)
class Pair:
    """A tested picture, its truth, and the error maps between them.

    Attributes:
        name: an effect's name, an engine's, that of an engine and of its layer with a space between, or "frame" for
            the whole frame; unique within a report.
        title: as people read it.
        terms: the terms it is judged on; empty for the frame.
        tested: float32 (H, W, 3).
        truth: float32 (H, W, 3).
        errors: one map or more; the first one is shown first.
        space: "scene-linear" (radiance or a ratio, any range) or "display" (code values, 0 to 1).
        unit: the unit of the pictures as it is printed.
        caption: one sentence on what is to be seen.
        mask: bool (H, W), True where the pair says something; None means everywhere. Masked pixels are drawn
            in the page's grey, so that "nothing arrives here" is not taken for "no error".
        labels: what the two pictures are called.
    """

    name: str
    title: str
    terms: tuple[str, ...]
    tested: npt.NDArray[np.float32]
    truth: npt.NDArray[np.float32]
    errors: tuple[ErrorMap, ...]
    space: Space = "scene-linear"
    unit: str = ""
    caption: str = ""
    mask: npt.NDArray[np.bool_] | None = None
    labels: tuple[str, str] = ("real-time", "truth")

    def __post_init__(self) -> None:
        for name in ("tested", "truth"):
            image = np.ascontiguousarray(getattr(self, name), dtype=np.float32)
            if image.ndim != 3 or image.shape[2] != 3 or image.size == 0:
                raise ValueError(f"pair '{self.name}', {name}: expected shape (H, W, 3), found {image.shape}")
            object.__setattr__(self, name, image)
        if not self.errors:
            raise ValueError(f"pair '{self.name}': expected at least one error map, found none")
        others = {"truth": self.truth.shape[:2]}
        others |= {f"error map '{error.name}'": error.values.shape for error in self.errors}
        if self.mask is not None:
            others["mask"] = self.mask.shape
        for what, shape in others.items():
            if shape != self.tested.shape[:2]:
                raise ValueError(
                    f"pair '{self.name}': tested is {self.tested.shape[:2]} (height, width), {what} is {shape}"
                )

    @property
    def size(self) -> tuple[int, int]:
        """(width, height) in pixels."""
        return self.tested.shape[1], self.tested.shape[0]


def rms_error(tested: npt.ArrayLike, truth: npt.ArrayLike, unit: str = "") -> ErrorMap:
    """Root mean square over the three channels of tested − truth, both (H, W, 3)."""
    difference = np.asarray(tested, np.float64) - np.asarray(truth, np.float64)
    values = np.sqrt(np.mean(difference**2, axis=2)).astype(np.float32)
    return ErrorMap("rms", "RMS error", values, unit, "magnitude")


def signed_error(tested: npt.ArrayLike, truth: npt.ArrayLike, unit: str = "") -> ErrorMap:
    """Mean over the three channels of tested − truth, both (H, W, 3): too bright is positive."""
    difference = np.asarray(tested, np.float64) - np.asarray(truth, np.float64)
    values = np.mean(difference, axis=2).astype(np.float32)
    return ErrorMap("signed", "Signed error", values, unit, "signed")


def flip_error(values: npt.ArrayLike) -> ErrorMap:
    """A FLIP map (H, W), computed elsewhere, as an error map with its range of 0 to 1."""
    return ErrorMap("flip", "FLIP", np.asarray(values, np.float32), "", "unit")


def share_map(metric: str, values: npt.ArrayLike, unit: str = "") -> ErrorMap:
    """Where in the image an effect's share of the frame's error lies, (H, W): its mean is the share.

    Signed: a negative pixel makes up for another effect's error. `unit` is that of the metric.
    """
    return ErrorMap(
        share_map_name(metric),
        f"Share of the frame's {error_phrase(metric)}",
        np.asarray(values, np.float32),
        unit,
        "signed",
    )


def share_map_name(metric: str) -> str:
    """The name of the map in an effect's pair: "share_mse", "share_flip"."""
    return f"share_{metric}"


def _robust_maximum(magnitudes: npt.NDArray[np.float32]) -> float:
    """99th percentile of the finite values; the maximum where that is 0 (thin errors); 1 where all are 0."""
    finite = magnitudes[np.isfinite(magnitudes)]
    if finite.size == 0:
        return 1.0
    high = float(np.percentile(finite, 99.0)) or float(finite.max())
    return high or 1.0
