"""Which truth was meant, in words."""

from lightmeter.groundtruth.scattering import SCATTERINGS, SINGLE
from lightmeter.reports.results import Reference


def truth_name(truth: str) -> str:
    """A truth with what it means; as it stands where it is not known."""
    return f"{truth}: {SCATTERINGS[truth]}" if truth in SCATTERINGS else truth


def truth_words(reference: Reference | None) -> str:
    """ " · truth …" where it is not the usual one, else ""."""
    return "" if reference is None or reference.truth == SINGLE else f" · truth {truth_name(reference.truth)}"
