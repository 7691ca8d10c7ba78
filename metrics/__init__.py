"""Metrics: how far one image is from another, and how sure that is."""

from .comparison import Comparison
from .finite import NonFinite, find_non_finite
from .input_error import InputError
from .measurement import Measurement
from .registry import METRICS, Metric, find_metric, measure, measure_all

__all__ = [
    "METRICS",
    "Comparison",
    "InputError",
    "Measurement",
    "Metric",
    "NonFinite",
    "find_metric",
    "find_non_finite",
    "measure",
    "measure_all",
]
