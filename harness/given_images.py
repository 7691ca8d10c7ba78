"""Images as a test has them at hand, in files or in arrays, judged and drawn."""

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from lightmeter import image_pair
from lightmeter.difference import picture
from lightmeter.failures import UsageError
from lightmeter.holding import hold_images
from lightmeter.image_pair import ImageFile
from lightmeter.reports.gate_markdown import Maps
from lightmeter.reports.verdict import Verdict

Given = str | Path | np.ndarray


def judge_images(
    tested: Given, reference: Given, limits: Sequence[str], confidence: float
) -> tuple[list[Verdict], Callable[[], Maps]]:
    """The verdicts on an image, and what draws its FLIP map.

    Args:
        tested: a file, or (H, W, 3), scene-linear.
        reference: a file, (H, W, 3), or (K, H, W, 3): K independent noisy batches.

    Raises:
        UsageError: a limit makes no sense, or an array is no image.
        ImageError, InputError: the files cannot be read, or the images not compared.
    """
    batches = isinstance(reference, np.ndarray) and reference.ndim == 4
    mean = reference.mean(axis=0) if batches and len(reference) else reference
    images = image_pair.pair(_file(tested, "the tested image"), _file(mean, "the reference"))
    sides = (images.tested, reference) if batches else (images, None)
    verdicts = hold_images(*sides, limits, confidence=confidence)
    return verdicts, lambda: {(verdicts[0].scene, verdicts[0].of): picture(images).errors[0]}


def _file(image: Given, name: str) -> ImageFile:
    """An image as one that was read."""
    if not isinstance(image, np.ndarray):
        return image_pair.read(Path(image))
    if image.ndim != 3 or image.shape[2] != 3 or not image.size:
        raise UsageError(f"{name}: expected an array (height, width, 3), got shape {image.shape}")
    if not np.issubdtype(image.dtype, np.floating):
        raise UsageError(
            f"{name}: expected scene-linear floating-point values, got {image.dtype}; decode code values first "
            "(scenes.optics.color.srgb_decode(image / 255)), or give the file's path"
        )
    return ImageFile(Path(name), image, is_display=False)
