"""What metrics are called in tables, what they mean in one or two sentences, and which ones come first."""

from collections.abc import Iterable, Mapping

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.significant import show_value

LABELS = {
    "mse": "MSE",
    "rmse": "RMSE",
    "rms_p95": "RMS p95",
    "rms_p99": "RMS p99",
    "rms_worst_tile": "RMS worst tile",
    "nrmse": "nRMSE",
    "relmse": "relMSE",
    "bias": "Bias",
    "relative_bias": "Relative bias",
    "mae": "MAE",
    "psnr": "PSNR",
    "ssim": "SSIM",
    "flip": "FLIP",
    "flip_p95": "FLIP p95",
    "flip_p99": "FLIP p99",
    "flip_worst_tile": "FLIP worst tile",
    "flip_hdr": "HDR-FLIP",
    "delta_e_2000": "ΔE2000",
    "delta_e_itp": "ΔE ITP",
}

# How to read a value, beyond the one sentence that the metric says of itself.
_READING = {
    "mse": "Noise of the reference is taken out, so it can come out slightly negative near 0.",
    "rmse": "In the picture's own unit; 0 is perfect.",
    "rms_p95": "95 % of the pixels are less wrong than this.",
    "rms_p99": "99 % of the pixels are less wrong than this.",
    "rms_worst_tile": "A small wrong highlight shows here, where a mean drowns it.",
    "nrmse": "0.01 means: off by one percent of the mean, in the root mean square. 0 is perfect.",
    "relmse": "0 is perfect.",
    "bias": "Positive is too bright.",
    "relative_bias": "Positive is too bright; 0.01 is one percent.",
    "mae": "0 is perfect.",
    "psnr": "In decibels; more is better.",
    "ssim": "1 is the same picture.",
    "flip": "0: no one would see it; 1: as different as can be.",
    "flip_p95": "95 % of the pixels differ less visibly than this.",
    "flip_p99": "99 % of the pixels differ less visibly than this.",
    "flip_worst_tile": "A small wrong highlight shows here, where a mean drowns it.",
    "flip_hdr": "0: no one would see it at any exposure; 1: as different as can be.",
    "delta_e_2000": "About 1 is just visible side by side.",
    "delta_e_itp": "1 is just visible under the best conditions.",
}

# What stands beside a mean, since a small wrong highlight drowns in a large right background: name to short label.
TAILS = {
    "rmse": {"p50": "median", "p99": "p99", "rms_p95": "p95", "rms_p99": "p99", "rms_worst_tile": "worst tile"},
    "flip": {"flip_p95": "p95", "flip_p99": "p99", "flip_worst_tile": "worst tile"},
}

_ERRORS = {"mse": "squared error"}


def error_phrase(name: str) -> str:
    """The error that a metric measures, as it stands in a sentence: "62 % of the frame's squared error"."""
    return _ERRORS.get(name, label(name))


def label(name: str) -> str:
    """The metric's name as it is printed; unknown names as they stand."""
    return LABELS.get(name, name)


def definition(name: str) -> str:
    """What the metric is and how to read it; "" for an unknown name."""
    from lightmeter.metrics.registry import METRICS

    summary = METRICS[name].summary if name in METRICS else ""
    return " ".join(part for part in (summary, _READING.get(name, "")) if part)


def beside_the_mean(name: str, metrics: Mapping[str, Measurement]) -> str:
    """The percentiles and the worst tile that go with a mean: "p95 0.21 · p99 0.43 · worst tile 0.38"; "" for none."""
    tails = TAILS.get(name, {})
    return " · ".join(f"{tails[tail]}\N{NO-BREAK SPACE}{show_value(metrics[tail])}" for tail in present(tails, metrics))


def present(wanted: Iterable[str], names: Iterable[str]) -> list[str]:
    """The wanted names that are there, in the order wanted."""
    there = set(names)
    return [name for name in wanted if name in there]


def in_order(names: Iterable[str]) -> list[str]:
    """Every name once: known metrics in their usual order, then the others as they come."""
    there = list(dict.fromkeys(names))
    known = present(LABELS, there)
    return known + [name for name in there if name not in LABELS]
