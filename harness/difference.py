"""How far one image is from another: every metric that makes sense, as results and as pictures."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lightmeter.device import fingerprint
from lightmeter.failures import UsageError
from lightmeter.image_pair import ImagePair
from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.finite import find_non_finite
from lightmeter.metrics.flip import PIXELS_PER_DEGREE, ldr_flip
from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.mse import RADIANCE
from lightmeter.metrics.registry import METRICS, find_metric, measure_all
from lightmeter.metrics.ssim import WINDOW
from lightmeter.reports import results as outcome
from lightmeter.reports.display_curve import DisplayCurve, srgb_curve
from lightmeter.reports.pictures import Pair, flip_error, rms_error, signed_error

FOR_HIGH_DYNAMIC_RANGE = ("flip_hdr", "delta_e_itp")
"""Metrics that say nothing of display images unless asked for."""

PPD_RANGE = (1.0, 500.0)


def difference(
    images: ImagePair, names: Sequence[str] = (), pixels_per_degree: float = PIXELS_PER_DEGREE
) -> outcome.Results:
    """The metrics of two images.

    Args:
        names: of metrics; empty: all that make sense.
        pixels_per_degree: for FLIP.

    Raises:
        UsageError: `pixels_per_degree` is out of range.
        InputError: a name is unknown, or the images are too small for a metric that was asked for.
    """
    low, high = PPD_RANGE
    if not low <= pixels_per_degree <= high:
        raise UsageError(f"--ppd: expected {low:g} to {high:g} pixels per degree, got {pixels_per_degree:g}")
    left_out = () if names else tuple(_left_out(images))
    chosen = list(names) or [name for name in METRICS if name not in {item.what for item in left_out}]
    for name in chosen:
        find_metric(name)
    bad = find_non_finite(images.tested)
    where = {"frame": tuple((column, row) for row, column in bad.first)} if bad else {}
    return outcome.Results(
        scene=f"{images.names[0]} against {images.names[1]}",
        size=(images.tested.shape[1], images.tested.shape[0]),
        device=fingerprint(),
        frame=outcome.Frame(_measure(images, chosen, pixels_per_degree)),
        left_out=left_out,
        nonfinite=outcome.NonFinite(bad.pixels, {}, where),
        notes=images.notes,
    )


def picture(images: ImagePair, pixels_per_degree: float = PIXELS_PER_DEGREE) -> Pair:
    """The pair with its error maps: FLIP of the display values, RMS and signed error.

    FLIP's filters would carry a pixel that is not finite all over the map: there it is drawn without such pixels, and
    they are marked.
    """
    is_display = images.space == "display"
    tested = images.tested_shown if is_display else images.tested
    truth = images.reference_shown if is_display else images.reference
    bad = np.isnan(images.tested_shown.sum(axis=2))
    sound = np.where(np.expand_dims(bad, 2), images.reference_shown, images.tested_shown)
    flip = np.where(bad, np.nan, ldr_flip(sound, images.reference_shown, pixels_per_degree))
    errors = (
        flip_error(flip),
        rms_error(tested, truth),
        signed_error(tested, truth),
    )
    caption = f"{images.names[0]} against {images.names[1]}."
    labels = ("tested", "reference")
    return Pair("frame", "Images", (), tested, truth, errors, space=images.space, caption=caption, labels=labels)


def display_curve(images: ImagePair) -> DisplayCurve | None:
    """How scene-linear images are shown; None for display images."""
    if images.space == "display":
        return None
    curve = srgb_curve()
    shifted = tuple(x - images.exposure for x in curve.log2_input)
    return DisplayCurve(shifted, curve.display, f"{images.exposure:+g} stops, sRGB" if images.exposure else "sRGB")


def _left_out(images: ImagePair):
    """Metrics that would say nothing of these images, and why."""
    if images.space == "display":
        for name in FOR_HIGH_DYNAMIC_RANGE:
            yield outcome.LeftOut(name, "it is for scene-linear images")
    if min(images.tested.shape[:2]) < WINDOW:
        yield outcome.LeftOut("ssim", f"its window is {WINDOW}×{WINDOW} pixels, and the images are smaller")


def _measure(images: ImagePair, names: list[str], pixels_per_degree: float) -> dict[str, Measurement]:
    """Display metrics of the display values, the others of the light; in the order of `names`."""
    shown = [name for name in names if METRICS[name].domain == "display" or _is_shown(name, images)]
    light = [name for name in names if name not in shown]
    found = {}
    for group, tested, reference in (
        (shown, images.tested_shown, images.reference_shown),
        (light, images.tested, images.reference),
    ):
        if group:
            known = {option for name in group for option in METRICS[name].options}
            options = {"pixels_per_degree": pixels_per_degree} if "pixels_per_degree" in known else {}
            found |= measure_all(group, Comparison(tested, reference), **options)
    return {name: _unitless(found[name]) for name in names}


def _is_shown(name: str, images: ImagePair) -> bool:
    """PSNR of display images is of their code values, as everyone else computes it."""
    return name == "psnr" and images.space == "display"


def _unitless(measurement: Measurement) -> Measurement:
    """A file does not say that its values are W/sr/m²."""
    return replace(measurement, unit="") if RADIANCE in measurement.unit else measurement
