"""Draws the shadow maps; the comparison is in shadow_map.glsl."""

from ...shadows.comparing import ComparedPasses as Passes

__all__ = ["Passes"]
