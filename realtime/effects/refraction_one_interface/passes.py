"""The environment's map."""

from ...glass.around import SurroundedPasses


class Passes(SurroundedPasses):
    """Nothing is drawn beforehand."""
