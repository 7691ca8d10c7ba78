"""Registration: what is commonly wrong with a frame is named, and corrected only where that was asked for."""

from dataclasses import dataclass

import numpy as np

from lightmeter.candidates.handed import Handed
from lightmeter.reports.results import Finding


@dataclass(frozen=True, eq=False)
class Registered:
    """A frame once it has been looked at.

    Attributes:
        image: (H, W, 3) float32, as it is measured.
        findings: what was found.
        outside: (H, W) bool, pixels that a correction left without content.
    """

    image: np.ndarray
    findings: tuple[Finding, ...]
    outside: np.ndarray


def register(handed: Handed, reference: np.ndarray, background: np.ndarray) -> Registered:
    """Look for faults, and correct those that are to be corrected.

    Args:
        reference: (K, H, W, 3) batches of the truth.
        background: (H, W) bool, where pixels' centres see no surface.
    """
    # Not before there is a candidate: SciPy's filters take a quarter of a second to import.
    from lightmeter.metrics.registration import correct, find_faults, outside

    truth = np.asarray(reference)
    if handed.display is not None:
        # What clipping took from the image is taken from the truth.
        truth = np.minimum(truth, handed.image.max(initial=0.0, where=np.isfinite(handed.image)))
    faults = find_faults(handed.image, truth, alpha=handed.alpha, background=background)
    asked = [fault for fault in faults if fault.name in handed.candidate.register]
    image = correct(handed.image, asked, alpha=handed.alpha) if asked else handed.image
    findings = tuple(Finding(f.name, f.words, dict(f.size), f in asked) for f in faults)
    return Registered(np.asarray(image, np.float32), findings, outside(asked, handed.image.shape))
