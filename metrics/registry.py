"""The metrics by name, for a command line, a limits file and a report."""

import difflib
import inspect
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from .bias import bias, relative_bias
from .comparison import Comparison, Images
from .delta_e import delta_e_2000, delta_e_itp
from .flip import flip, flip_hdr
from .input_error import InputError
from .mae import mae
from .measurement import Measurement
from .mse import RADIANCE, mse, nrmse, relmse, rmse
from .percentile import flip_p95, flip_p99, rms_p95, rms_p99
from .psnr import psnr
from .ssim import ssim
from .worst_tile import flip_worst_tile, rms_worst_tile


@dataclass(frozen=True)
class Metric:
    """A metric that can be asked for by name.

    Attributes:
        name: as it is written on the command line and in results.
        summary: one sentence.
        unit: the value's unit; "" for a pure number.
        domain: "scene-linear" for radiance, "display" for what a `display` transform makes of it.
        larger_is_worse: False where a larger value means closer images. Signed metrics are judged by magnitude.
        citation: the source.
        function: takes a Comparison and options by keyword, gives a Measurement.
        signed: whether the sign has a meaning, so that a limit applies to the magnitude.
    """

    name: str
    summary: str
    unit: str
    domain: Literal["scene-linear", "display"]
    larger_is_worse: bool
    citation: str
    function: Callable[..., Measurement]
    signed: bool = False

    @property
    def options(self) -> tuple[str, ...]:
        """The names of the keyword options that the function takes."""
        return tuple(inspect.signature(self.function).parameters)[1:]


_U_STATISTIC = "Hoeffding 1948 (U-statistic), Arvesen 1969 (its jackknife)"
_FLIP = "Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild 2020"
_PERCENTILE = "Hyndman, Fan 1996 (type 7)"
_TILE = "Hoeffding 1948 (U-statistic of each tile)"
_HDR_FLIP = "Andersson, Nilsson, Shirley, Akenine-Möller 2021"

METRICS: dict[str, Metric] = {
    metric.name: metric
    for metric in (
        Metric("mse", "Mean squared error, unbiased by the reference's noise.", f"({RADIANCE})²",
               "scene-linear", True, _U_STATISTIC, mse),
        Metric("rmse", "Root of the mean squared error.", RADIANCE, "scene-linear", True, _U_STATISTIC, rmse),
        Metric("nrmse", "RMSE over the reference's mean.", "", "scene-linear", True, _U_STATISTIC, nrmse),
        Metric("relmse", "Mean squared error over the reference's mean square.", "", "scene-linear", True,
               _U_STATISTIC, relmse),
        Metric("bias", "Signed mean difference, tested minus reference.", RADIANCE, "scene-linear", True,
               "Quenouille 1949 (jackknife)", bias, signed=True),
        Metric("relative_bias", "Signed mean difference over the reference's mean.", "", "scene-linear", True,
               "Quenouille 1949 (jackknife)", relative_bias, signed=True),
        Metric("mae", "Mean absolute error.", RADIANCE, "scene-linear", True, "McCarthy 1969 (half-samples)", mae),
        Metric("rms_p95", "95th percentile over pixels of the RMS error.", RADIANCE, "scene-linear", True,
               _PERCENTILE, rms_p95),
        Metric("rms_p99", "99th percentile over pixels of the RMS error.", RADIANCE, "scene-linear", True,
               _PERCENTILE, rms_p99),
        Metric("rms_worst_tile", "Largest RMSE of any tile of 16 × 16 pixels.", RADIANCE, "scene-linear", True,
               _TILE, rms_worst_tile),
        Metric("psnr", "Peak signal-to-noise ratio of the unbiased MSE at a stated peak.", "dB", "scene-linear",
               False, _U_STATISTIC, psnr),
        Metric("ssim", "Structural similarity of the display images.", "", "display", False,
               "Wang, Bovik, Sheikh, Simoncelli 2004", ssim),
        Metric("flip", "Visible difference when display images are flipped.", "", "display", True, _FLIP, flip),
        Metric("flip_p95", "95th percentile over pixels of FLIP.", "", "display", True,
               f"{_FLIP}; {_PERCENTILE}", flip_p95),
        Metric("flip_p99", "99th percentile over pixels of FLIP.", "", "display", True,
               f"{_FLIP}; {_PERCENTILE}", flip_p99),
        Metric("flip_worst_tile", "Largest mean FLIP of any tile of 16 × 16 pixels.", "", "display", True, _FLIP,
               flip_worst_tile),
        Metric("flip_hdr", "Largest FLIP over a range of exposures.", "", "scene-linear", True, _HDR_FLIP, flip_hdr),
        Metric("delta_e_2000", "Mean CIEDE2000 colour difference of the display images.", "ΔE", "display", True,
               "CIE 142-2001; Sharma, Wu, Dalal 2005", delta_e_2000),
        Metric("delta_e_itp", "Mean colour difference for high dynamic range.", "ΔE", "scene-linear", True,
               "ITU-R BT.2124-0 2019", delta_e_itp),
    )
}  # fmt: skip


def find_metric(name: str) -> Metric:
    """The metric of that name.

    Raises:
        InputError: there is none; names the nearest.
    """
    if name in METRICS:
        return METRICS[name]
    raise _unknown("metric", name, METRICS)


def measure(
    name: str, tested: Images, reference: Images, mask: np.ndarray | None = None, **options: Any
) -> Measurement:
    """One metric by name.

    Args:
        name: a key of METRICS.
        tested: (H, W, 3), or K batches of it.
        reference: K batches (K, H, W, 3), or one (H, W, 3).
        mask: (H, W) boolean, True where pixels count.
        **options: the metric's own (`Metric.options`), such as `display`, `peak`, `pixels_per_degree`, `bound`.

    Raises:
        InputError: the name or an option is unknown, or the input cannot be compared.
    """
    metric = find_metric(name)
    for option in options:
        if option not in metric.options:
            raise _unknown(f"option of {name}", option, metric.options)
    return metric.function(Comparison(tested, reference, mask), **options)


def measure_all(names: Iterable[str], comparison: Comparison, **options: Any) -> dict[str, Measurement]:
    """Several metrics of one comparison, which share its sums. Each metric takes the options that it has.

    Raises:
        InputError: a name is unknown, an option is one that none of the metrics has, or the input cannot be compared.
    """
    metrics = [find_metric(name) for name in names]
    known = {option for metric in metrics for option in metric.options}
    for option in options:
        if option not in known:
            raise _unknown("option of these metrics", option, known)
    return {
        metric.name: metric.function(comparison, **{o: v for o, v in options.items() if o in metric.options})
        for metric in metrics
    }


def _unknown(kind: str, name: str, valid: Iterable[str]) -> InputError:
    valid = sorted(valid)
    near = difflib.get_close_matches(name, valid, n=1, cutoff=0.4)
    return InputError(
        f"unknown {kind}",
        expected=f"one of {', '.join(valid)}" if valid else "none",
        actual=repr(name),
        remedy=f"Did you mean {near[0]!r}?" if near else "See `lightmeter diff --help`.",
    )
