"""The two images that are held against each other, checked, linear, finite, and laid one on the other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.ndimage import distance_transform_edt

from ..comparison import Comparison
from ..input_error import InputError
from .curves import srgb_decode
from .edges import LUMINANCE
from .flip import Flip
from .placement import Placement, inside


@dataclass(frozen=True, eq=False)
class Sides:
    """A tested image and the truth, pixel by pixel.

    Attributes:
        tested: (H, W, 3) float64, linear, at least 0; what is not finite is filled from beside it.
        truth: (H, W, 3) likewise, the mean of the batches.
        variance: (H, W, 3) of the truth's noise; None of a single batch.
        valid: (H, W) bool, where both are what was handed in.
        alpha: (H, W) in 0…1, or None.
        background: (H, W) bool where pixels' centres see no surface, or None.
    """

    tested: np.ndarray
    truth: np.ndarray
    variance: np.ndarray | None
    valid: np.ndarray
    alpha: np.ndarray | None
    background: np.ndarray | None

    @classmethod
    def of(
        cls,
        tested: np.ndarray,
        reference: np.ndarray | Sequence[np.ndarray],
        alpha: np.ndarray | None,
        background: np.ndarray | None,
        display: bool,
    ) -> Sides:
        """Both sides as they were handed in.

        Raises:
            InputError: shapes do not fit.
        """
        checked = Comparison(tested, reference)
        for name, plane in (("alpha", alpha), ("background", background)):
            if plane is not None and np.shape(plane) != (checked.height, checked.width):
                raise InputError(
                    f"the {name} does not fit the images",
                    expected=f"shape ({checked.height}, {checked.width})",
                    actual=str(np.shape(plane)),
                    remedy="Give a value for every pixel, or leave it out.",
                )
        linear = srgb_decode if display else np.asarray
        image = np.asarray(tested, np.float64)
        total, squares = np.zeros(image.shape), np.zeros(image.shape)
        fine = _finite(image)
        for batch in checked.reference:
            good = _finite(batch)
            fine &= good
            light = linear(np.where(good[..., None], batch, 0.0).astype(np.float64))
            total += light
            squares += light**2
        count = checked.batches
        truth = total / count
        variance = np.maximum(squares / count - truth**2, 0.0) / (count - 1) if count > 1 else None
        image = linear(_filled(image, fine))
        return cls(
            np.maximum(image, 0.0),
            np.maximum(_filled(truth, fine), 0.0),
            None if variance is None else _filled(variance, fine),
            fine,
            None if alpha is None else np.clip(np.nan_to_num(np.asarray(alpha, np.float64), nan=1.0), 0.0, 1.0),
            None if background is None else np.asarray(background, bool),
        )

    @property
    def luminances(self) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
        """(H, W) of the tested image, of the truth, and the variance of the truth's noise (channels go together)."""
        deviation = None if self.variance is None else np.sqrt(self.variance) @ LUMINANCE
        return self.tested @ LUMINANCE, self.truth @ LUMINANCE, None if deviation is None else deviation**2

    def without_flip(self, flip: Flip) -> Sides:
        """The tested image mirrored back."""
        tested, alpha = flip.undo(self.tested), None if self.alpha is None else flip.undo(self.alpha)
        if not (flip.across or flip.upright):
            return self
        return replace(self, tested=tested, alpha=alpha, valid=self.valid & flip.undo(self.valid))

    def aligned(self, placement: Placement) -> Sides:
        """The truth laid as the tested image; pixels that it does not have are not valid."""
        if placement == Placement():
            return self
        shape = self.valid.shape
        background = self.background
        if background is not None:
            background = placement.place(background.astype(float)) > 0.5
        return replace(
            self,
            truth=placement.place(self.truth),
            variance=None if self.variance is None else placement.place(self.variance),
            valid=self.valid & inside(*placement.sources(shape), shape),
            background=background,
        )


def _finite(image: np.ndarray) -> np.ndarray:
    """(H, W) bool: where all three channels are finite; by channel, since NumPy is slow along an axis of three."""
    return np.logical_and.reduce([np.isfinite(image[..., channel]) for channel in range(3)])


def _filled(image: np.ndarray, fine: np.ndarray) -> np.ndarray:
    """The image with what is not fine taken from the nearest pixel that is; 0 where none is."""
    if fine.all():
        return image
    if not fine.any():
        return np.zeros(image.shape)
    rows, columns = np.asarray(distance_transform_edt(~fine, return_distances=False, return_indices=True))
    return image[rows, columns]
