"""Bakes the cube map."""

from ...reflections.baked_cube import BakedCube


class Passes(BakedCube):
    """The cube map of the scene's middle."""
