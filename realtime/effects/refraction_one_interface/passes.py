"""What is around."""

from ...glass.around import SurroundedPasses


class Passes(SurroundedPasses):
    """Nothing is drawn beforehand."""
