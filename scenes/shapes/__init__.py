"""Procedural shapes, as meshes: closed ones face outwards, all have smooth normals and texture coordinates.

Texture coordinates are laid so that an image is not mirrored seen from outside.
"""

from lightmeter.scenes.shapes.box import box
from lightmeter.scenes.shapes.cylinder import cone, cylinder
from lightmeter.scenes.shapes.disk import disk
from lightmeter.scenes.shapes.plane import plane, rectangle
from lightmeter.scenes.shapes.sphere import sphere
from lightmeter.scenes.shapes.torus import torus

__all__ = ["box", "cone", "cylinder", "disk", "plane", "rectangle", "sphere", "torus"]
