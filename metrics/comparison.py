"""The two sides of a comparison, checked once, with the sums that several metrics share."""

from collections.abc import Hashable, Sequence
from functools import cached_property
from typing import Any

import numpy as np

from .finite import NonFinite, find_non_finite
from .input_error import InputError
from .measurement import Measurement
from .moments import Moments

Images = np.ndarray | Sequence[np.ndarray]


class Comparison:
    """A tested image against a reference that comes as independent batches.

    Nothing is copied: the batches may be one array, a memory map, or a list of images. What metrics share (inner
    products, means) is computed when first asked for and kept.

    Args:
        tested: (H, W, 3); or (K, H, W, 3), K independent batches, where the tested side is noisy too
            (closure): batch k is then paired with the reference's batch k.
        reference: (K, H, W, 3) or K images (H, W, 3): independent batches of equal expectation and variance. A single
            (H, W, 3) image is K = 1: values come without intervals.
        mask: (H, W) boolean, True where pixels count; all when None.
        confidence: of every interval that a metric gives of this comparison, two-sided, in (0, 1).

    Raises:
        InputError: a shape is wrong, sizes or batch counts differ, the mask is not boolean or empty, the confidence
            is not between 0 and 1, or the reference holds a NaN or an infinity inside the mask.
    """

    def __init__(
        self, tested: Images, reference: Images, mask: np.ndarray | None = None, confidence: float = 0.95
    ) -> None:
        self.reference = _batches(reference, "reference")
        self.tested_batches = _batches(tested, "tested image")
        self.height, self.width = self.reference[0].shape[:2]
        self.mask = mask
        self.confidence = confidence
        self.maps: dict[Hashable, Any] = {}  # of metrics that share them
        self._reference_checked: np.ndarray | str | None = "not yet"
        if self.tested_batches[0].shape != self.reference[0].shape:
            height, width = self.tested_batches[0].shape[:2]
            raise InputError(
                "the images differ in size",
                expected=f"{self.width}×{self.height}, the reference's size",
                actual=f"{width}×{height}",
                remedy="Render or resample one of them to the other's size.",
            )
        if len(self.tested_batches) not in (1, len(self.reference)):
            raise InputError(
                "the two sides differ in batches",
                expected=f"one tested image, or {len(self.reference)} batches of it as of the reference",
                actual=str(len(self.tested_batches)),
                remedy="Leave out the surplus batches: batch k of one side is paired with batch k of the other.",
            )
        if not 0 < confidence < 1:
            raise InputError(
                "the confidence of an interval is no probability",
                expected="a number between 0 and 1",
                actual=str(confidence),
                remedy="95 % is 0.95.",
            )
        if mask is not None and (mask.shape != (self.height, self.width) or mask.dtype != np.bool_):
            raise InputError(
                "the mask does not fit the images",
                expected=f"a boolean array of shape ({self.height}, {self.width})",
                actual=f"{mask.dtype} of shape {mask.shape}",
                remedy="Give True for the pixels that count.",
            )
        if mask is not None and not mask.any():
            raise InputError(
                "the mask is empty",
                expected="at least one pixel that counts",
                actual="none",
                remedy="Leave the mask out, or check how it was made.",
            )

    @property
    def batches(self) -> int:
        """K, the number of reference batches."""
        return len(self.reference)

    @property
    def paired(self) -> bool:
        """Whether the tested side comes as batches too."""
        return len(self.tested_batches) > 1

    @cached_property
    def non_finite(self) -> NonFinite:
        """What is not finite in the tested side inside the mask (the first such batch, if it comes as batches)."""
        return self._search(self.mask)

    @cached_property
    def non_finite_anywhere(self) -> NonFinite:
        """The same in the whole image, for metrics whose filters read past the mask."""
        return self.non_finite if self.mask is None else self._search(None)

    def _search(self, mask: np.ndarray | None) -> NonFinite:
        found = NonFinite(0, 0, 0, 0, ())
        for image in self.tested_batches:
            found = find_non_finite(image, mask)
            if found:
                break
        return found

    def unusable(self, spatial: bool = False) -> bool:
        """Whether the tested side has a non-finite pixel that a metric would read."""
        return bool(self.non_finite_anywhere if spatial else self.non_finite)

    def failure(self, unit: str) -> Measurement:
        """The measurement of a tested side that has non-finite pixels: NaN, and where they are."""
        return Measurement(np.nan, unit=unit, how=f"failed: {self.non_finite or self.non_finite_anywhere}")

    @cached_property
    def moments(self) -> Moments:
        """Inner products and means over the pixels that count."""
        moments = Moments.of(self.tested_batches, self.reference, self.mask)
        # What float32 cannot hold shows in the sums, unless they were added up from wider numbers.
        wide = any(image.dtype.itemsize > 4 for image in self.reference)
        if wide or not (np.isfinite(moments.gram).all() and np.isfinite(moments.reference_means).all()):
            self.check_reference(self.mask)
        return moments

    @cached_property
    def mean_reference(self) -> np.ndarray:
        """(H, W, 3) float64, the mean of all batches."""
        return _mean(self.reference)

    @cached_property
    def mean_tested(self) -> np.ndarray:
        """(H, W, 3), the tested image, or the mean of its batches in float64."""
        return _mean(self.tested_batches) if self.paired else self.tested_batches[0]

    def reference_part(self, quarters: Sequence[int]) -> np.ndarray:
        """(H, W, 3) float64, the mean of some quarters of the batches: batch k belongs to quarter k mod 4."""
        if len(quarters) == 4:
            return self.mean_reference
        return _part(self._reference_quarters, quarters)

    def tested_part(self, quarters: Sequence[int]) -> np.ndarray:
        """The tested image, or the mean of those quarters of its batches where it comes as batches."""
        if not self.paired or len(quarters) == 4:
            return self.mean_tested
        return _part(self._tested_quarters, quarters)

    @cached_property
    def _reference_quarters(self) -> list[tuple[int, np.ndarray]]:
        return _quarters(self.reference)

    @cached_property
    def _tested_quarters(self) -> list[tuple[int, np.ndarray]]:
        return _quarters(self.tested_batches)

    def check_reference(self, mask: np.ndarray | None) -> None:
        """Raises InputError where a reference batch is not finite inside `mask`."""
        if mask is self._reference_checked:
            return
        for index, image in enumerate(self.reference):
            found = find_non_finite(image, mask)
            if found:
                raise InputError(
                    f"batch {index} of the reference is not finite",
                    expected="finite radiance everywhere",
                    actual=str(found),
                    remedy="Render that batch again, or mask these pixels out.",
                )
        self._reference_checked = mask


def _batches(images: Images, side: str) -> list[np.ndarray]:
    if isinstance(images, np.ndarray):
        found = [images] if images.ndim == 3 else list(images) if images.ndim == 4 else None
    else:
        found = [np.asarray(image) for image in images]
    if not found or any(i.ndim != 3 or i.shape[2] != 3 or i.size == 0 for i in found):
        shape = images.shape if isinstance(images, np.ndarray) else [i.shape for i in found or []]
        raise InputError(
            f"the {side} is not colour images",
            expected="shape (height, width, 3), or (batches, height, width, 3)",
            actual=str(shape),
            remedy="Give three channels and at least one batch; repeat a grey image three times.",
        )
    if any(i.shape != found[0].shape for i in found):
        raise InputError(
            f"the batches of the {side} differ in size",
            expected=f"{found[0].shape} for all",
            actual=str(sorted({i.shape for i in found})),
            remedy="Batches must come from one camera at one size.",
        )
    return found


def _mean(images: Sequence[np.ndarray]) -> np.ndarray:
    total = np.zeros(images[0].shape, np.float64)
    for image in images:
        total += image
    return total / len(images)


def _quarters(images: Sequence[np.ndarray]) -> list[tuple[int, np.ndarray]]:
    """How many images each quarter has, and their mean."""
    return [(len(quarter), _mean(quarter)) for q in range(4) if (quarter := images[q::4])]


def _part(quarters: list[tuple[int, np.ndarray]], which: Sequence[int]) -> np.ndarray:
    chosen = [quarters[q] for q in which if q < len(quarters)]
    count = sum(n for n, _ in chosen)
    return np.sum([mean * (n / count) for n, mean in chosen], axis=0)
