"""Registration: what is commonly wrong with a frame is named, and corrected only where that was asked for."""

import numpy as np

from lightmeter.candidates.handed import Handed
from lightmeter.metrics.registration import correct, find_faults
from lightmeter.reports.results import Finding


def register(handed: Handed, reference: np.ndarray, background: np.ndarray) -> tuple[np.ndarray, tuple[Finding, ...]]:
    """The image to be measured, (H, W, 3) float32, and what was found.

    Args:
        reference: (K, H, W, 3) batches of the truth.
        background: (H, W) bool, where pixels' centres see no surface.
    """
    truth = reference
    if handed.display is not None:
        # What clipping took from the image is taken from the truth.
        truth = np.minimum(reference, handed.image.max(initial=0.0, where=np.isfinite(handed.image)))
    faults = find_faults(handed.image, truth, alpha=handed.alpha, background=background)
    asked = [fault for fault in faults if fault.name in handed.candidate.register]
    image = correct(handed.image, asked, alpha=handed.alpha) if asked else handed.image
    findings = tuple(Finding(f.name, f.words, dict(f.size), f in asked) for f in faults)
    return np.asarray(image, np.float32), findings
