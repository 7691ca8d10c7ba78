"""What metrics are called in tables, what they mean in one or two sentences, and which ones come first."""

from collections.abc import Iterable

LABELS = {
    "mse": "MSE",
    "rmse": "RMSE",
    "nrmse": "nRMSE",
    "relmse": "relMSE",
    "bias": "Bias",
    "relative_bias": "Relative bias",
    "mae": "MAE",
    "rms_p95": "RMS error, 95th percentile",
    "rms_p99": "RMS error, 99th percentile",
    "rms_worst_tile": "RMSE, worst tile",
    "psnr": "PSNR",
    "ssim": "SSIM",
    "flip": "FLIP",
    "flip_p95": "FLIP, 95th percentile",
    "flip_p99": "FLIP, 99th percentile",
    "flip_worst_tile": "FLIP, worst tile",
    "flip_hdr": "HDR-FLIP",
    "delta_e_2000": "ΔE2000",
    "delta_e_itp": "ΔE ITP",
}

# How to read a value, beyond the one sentence that the metric says of itself.
_READING = {
    "mse": "Noise of the reference is taken out, so it can come out slightly negative near 0.",
    "rmse": "In the picture's own unit; 0 is perfect.",
    "nrmse": "0.01 means: off by one percent of the mean, in the root mean square. 0 is perfect.",
    "relmse": "0 is perfect.",
    "bias": "Positive is too bright.",
    "relative_bias": "Positive is too bright; 0.01 is one percent.",
    "mae": "0 is perfect.",
    "rms_p95": "One pixel in twenty is worse than this.",
    "rms_p99": "One pixel in a hundred is worse than this.",
    "rms_worst_tile": "A small wrong place shows here, however large and right the rest is.",
    "psnr": "In decibels; more is better.",
    "ssim": "1 is the same picture.",
    "flip": "0: no one would see it; 1: as different as can be.",
    "flip_p95": "One pixel in twenty differs more visibly than this.",
    "flip_p99": "One pixel in a hundred differs more visibly than this.",
    "flip_worst_tile": "A small wrong place shows here, however large and right the rest is.",
    "flip_hdr": "0: no one would see it at any exposure; 1: as different as can be.",
    "delta_e_2000": "About 1 is just visible side by side.",
    "delta_e_itp": "1 is just visible under the best conditions.",
}


def label(name: str) -> str:
    """The metric's name as it is printed; unknown names as they stand."""
    return LABELS.get(name, name)


def definition(name: str) -> str:
    """What the metric is and how to read it; "" for an unknown name."""
    from lightmeter.metrics.registry import METRICS

    summary = METRICS[name].summary if name in METRICS else ""
    return " ".join(part for part in (summary, _READING.get(name, "")) if part)


def present(wanted: Iterable[str], names: Iterable[str]) -> list[str]:
    """The wanted names that are there, in the order wanted."""
    there = set(names)
    return [name for name in wanted if name in there]


def in_order(names: Iterable[str]) -> list[str]:
    """Every name once: known metrics in their usual order, then the others as they come."""
    there = list(dict.fromkeys(names))
    known = present(LABELS, there)
    return known + [name for name in there if name not in LABELS]
