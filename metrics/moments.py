"""The sums over pixels from which the whole MSE family follows, taken in one pass over the batches.

With d_k = T − R_k (or T_k − R_k) as long vectors of n = 3 · pixels values, everything that the U-statistics, their
jackknife and their intervals need is in the K×K Gram matrix ⟨d_k, d_l⟩ / n, the reference's own Gram matrix and K
means: O(K²) numbers. The pass works on a strip of rows at a time, in float64, so that the stack is never copied.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

_STRIP_VALUES = 1 << 18  # 2 MB of float64: a strip of all batches stays in the cache while it is multiplied


@dataclass(frozen=True)
class Moments:
    """Inner products of K batches over the pixels that count.

    Attributes:
        values: n, the number of values in a batch: 3 times the number of pixels that count.
        gram: (K, K) float64, the mean over values of d_k · d_l.
        reference_gram: (K, K) float64, the mean over values of R_k · R_l.
        difference_means: (K,) float64, the mean of d_k.
        reference_means: (K,) float64, the mean of R_k.
    """

    values: int
    gram: np.ndarray
    reference_gram: np.ndarray
    difference_means: np.ndarray
    reference_means: np.ndarray

    @property
    def batches(self) -> int:
        """K."""
        return len(self.reference_means)

    @classmethod
    def of(
        cls, tested: Sequence[np.ndarray], reference: Sequence[np.ndarray], mask: np.ndarray | None = None
    ) -> Moments:
        """Sums over K reference images (H, W, 3) and one or K tested ones, inside a boolean (H, W) mask."""
        batches = len(reference)
        height, width, _ = reference[0].shape
        rows = max(1, min(height, _STRIP_VALUES // (batches * width * 3)))
        gram = np.zeros((batches, batches))
        reference_gram = np.zeros((batches, batches))
        difference_sums = np.zeros(batches)
        reference_sums = np.zeros(batches)
        references = np.empty((batches, rows, width, 3))
        differences = np.empty_like(references)
        with np.errstate(invalid="ignore", over="ignore"):
            for top in range(0, height, rows):
                strip = slice(top, min(top + rows, height))
                n = strip.stop - strip.start
                for k, image in enumerate(reference):
                    references[k, :n] = image[strip]
                    other = tested[k if len(tested) > 1 else 0]
                    np.subtract(other[strip], references[k, :n], out=differences[k, :n])
                if mask is not None:
                    # Assigned, not multiplied: outside the mask may be NaN.
                    references[:, :n][:, ~mask[strip]] = 0
                    differences[:, :n][:, ~mask[strip]] = 0
                r = references[:, :n].reshape(batches, -1)
                d = differences[:, :n].reshape(batches, -1)
                gram += d @ d.T
                reference_gram += r @ r.T
                difference_sums += d.sum(axis=1)
                reference_sums += r.sum(axis=1)
        values = 3 * (height * width if mask is None else int(mask.sum()))
        return cls(values, gram / values, reference_gram / values, difference_sums / values, reference_sums / values)
