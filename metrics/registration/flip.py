"""Whether an image is mirrored."""

from dataclasses import dataclass

import numpy as np
from scipy.fft import next_fast_len

from .edges import directions, gradients
from .fault import Fault
from .resampling import reduce

FLIPS = ((False, False), (True, False), (False, True), (True, True))
"""(left to right, up to down)."""
_SIDE = 128  # pixels of the longer side at which images are compared
_BLURS = (0.8, 2.5, 8.0)  # pixels at that side: edges, shapes, and where the light comes from
_FARTHEST = 0.1  # of the side: how far apart the two images may lie
_LEAST = 0.4  # the score that a mirrored image has to have,
_LEAD = 0.15  # and by how much it has to be better than the image as it is
_ALIKE = 0.995  # a correlation above this counts as this


@dataclass(frozen=True)
class Flip:
    """How an image is mirrored, and roughly where it then lies.

    Attributes:
        across: left and right are exchanged.
        upright: up and down are exchanged.
        right, down: how far the image lies from the reference once the flip is undone, pixels, to about a hundredth of
            the image's side.
    """

    across: bool
    upright: bool
    right: float
    down: float

    def undo(self, image: np.ndarray) -> np.ndarray:
        """(H, W, …): the image mirrored back."""
        return mirror(image, self.across, self.upright)


def mirror(image: np.ndarray, across: bool, upright: bool) -> np.ndarray:
    """(H, W, …): columns and rows in the other order."""
    return image[:: -1 if upright else 1, :: -1 if across else 1]


def flip_fault(flip: Flip) -> Fault | None:
    """The flip in words, if there is one."""
    words = {(True, False): "mirrored left to right", (False, True): "upside down", (True, True): "turned by 180°"}
    how = (flip.across, flip.upright)
    if how not in words:
        return None
    return Fault("flip", words[how], {"left_right": float(flip.across), "up_down": float(flip.upright)})


def find_flip(tested: np.ndarray, reference: np.ndarray, variance: np.ndarray | None) -> Flip:
    """The flip under which the images' gradients agree best, if it is clearly better than none.

    At three scales the directions of gradients are correlated at all shifts of up to a tenth of the image; the score
    is the mean of the correlations' Fisher transforms (atanh), under which equal steps are equally telling.

    Args:
        tested, reference: (H, W) luminance, finite, not negative.
        variance: (H, W) of the reference's noise, or None.
    """
    factor = -(-max(tested.shape) // _SIDE)
    tested, reference = reduce(tested, factor), reduce(reference, factor)
    variance = None if variance is None else reduce(variance, factor) / factor**2
    height, width = tested.shape
    if min(height, width) < 8:
        return Flip(False, False, 0.0, 0.0)
    far = max(2, int(_FARTHEST * height)), max(2, int(_FARTHEST * width))
    scores = np.zeros((len(FLIPS), 2 * far[0] + 1, 2 * far[1] + 1))
    for blur in _BLURS:
        scale = min(blur * max(height, width) / _SIDE if blur > 1 else blur, min(height, width) / 8)
        of_tested, of_reference = directions(gradients(tested, scale), gradients(reference, scale, variance))
        for index, flip in enumerate(FLIPS):
            scores[index] += _correlations(_mirrored(of_tested, *flip), of_reference, far)
    scores /= len(_BLURS)
    best = scores.reshape(len(FLIPS), -1).max(axis=1)
    found = int(np.argmax(best))
    if best[found] < _LEAST or best[found] < best[0] + _LEAD:
        found = 0
    row, column = np.unravel_index(np.argmax(scores[found]), scores.shape[1:])
    return Flip(*FLIPS[found], float(factor * (column - far[1])), float(factor * (row - far[0])))


def _mirrored(field: np.ndarray, across: bool, upright: bool) -> np.ndarray:
    """(2, H, W): the gradients of the mirrored image."""
    right, down = (mirror(part, across, upright) for part in field)
    return np.stack([-right if across else right, -down if upright else down])


def _correlations(one: np.ndarray, other: np.ndarray, far: tuple[int, int]) -> np.ndarray:
    """(2·far + 1, …): atanh of the correlation of two fields, by how far down and right the first one lies."""
    power = float(np.sqrt((one**2).sum() * (other**2).sum()))
    rows, columns = 2 * far[0] + 1, 2 * far[1] + 1
    if not power > 0:
        return np.zeros((rows, columns))
    size = [next_fast_len(side + reach) for side, reach in zip(one.shape[1:], far, strict=True)]
    product = (np.fft.rfft2(one, size) * np.conj(np.fft.rfft2(other, size))).sum(axis=0)
    shifted = np.roll(np.fft.irfft2(product, size), far, axis=(0, 1))[:rows, :columns]
    return np.arctanh(np.clip(shifted / power, -_ALIKE, _ALIKE))
