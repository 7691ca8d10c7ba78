"""Weights of samples that two strategies could have drawn."""

from lightmeter.groundtruth.variant import dr


def power_heuristic(a, b):
    """The share of a sample of density `a`, where another strategy has density `b` (Veach & Guibas 1995, β = 2)."""
    ratio = b / dr.maximum(a, 1e-30)
    return dr.select(a > 0, 1 / (1 + ratio * ratio), 0)
