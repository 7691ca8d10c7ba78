"""Registration: what is commonly wrong with a whole frame is found, named with its size, and undone when asked."""

from .correction import ORDER, correct, outside
from .fault import Fault
from .finding import find_faults

__all__ = ["ORDER", "Fault", "correct", "find_faults", "outside"]
