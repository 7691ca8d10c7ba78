"""Surfaces that keep all light, or none, and textures that hold no colour."""

import numpy as np

from lightmeter.scenes import shapes
from lightmeter.scenes.model import Image, Material, PointLight, Scene, Texture
from lightmeter.scenes.stiff.case import StiffCase, at, room, viewer
from lightmeter.scenes.stiff.lights import DARK

MIRROR = Material("mirror", (1.0, 1.0, 1.0), metallic=1.0, roughness=0.0)


def mirror_in_mirror() -> Scene:
    """Two mirrors face each other; the ball between them is seen many times."""
    behind, before = shapes.rectangle(4.0, 3.0), shapes.rectangle(4.0, 3.0)
    front = at("front", before, (0.0, 1.5, 6.0), MIRROR)
    front.matrix[:3, :3] = np.diag((-1.0, 1.0, -1.0))  # half a turn about Y
    return room(at("back", behind, (0.0, 1.5, -2.0), MIRROR), front, max_depth=16)


def enclosed(reflectance: float) -> Scene:
    """A lamp in a closed box that the camera is in too. At a reflectance of 1 it fills up, path by path."""
    wall = Material("wall", (reflectance,) * 3, specular=0.0, double_sided=True)
    lamp = PointLight("lamp", (0.5, 2.0, 0.0), (1.0, 1.0, 1.0))
    box = at("box", shapes.box(10.0, 10.0, 10.0), (0.0, 4.0, 0.0), wall)
    return Scene("stiff", (box,), viewer(), (lamp,), None, max_depth=64)


def textured(texels: np.ndarray) -> Scene:
    """The ball's base colour from these texels."""
    texture = Texture(Image(np.asarray(texels, np.float32), "texels"))
    return room(ball=Material("textured", base_color_texture=texture), environment=DARK)


def _with_texel(value: float) -> Scene:
    texels = np.full((4, 4, 3), 0.5, np.float32)
    texels[1, 2, 0] = value
    return textured(texels)


CASES = {
    "mirror-in-mirror": StiffCase("two mirrors face each other", mirror_in_mirror),
    "black": StiffCase("a box that reflects nothing", lambda: enclosed(0.0)),
    "white": StiffCase("a closed box that loses no light, paths of 64", lambda: enclosed(1.0)),
    "one-texel": StiffCase("a texture of 1 × 1", lambda: textured(np.full((1, 1, 3), 0.25))),
    "nan-texel": StiffCase("a texel that is no number", lambda: _with_texel(np.nan), refused="1 NaN"),
    "inf-texel": StiffCase("an infinite texel", lambda: _with_texel(np.inf), refused="1 +inf"),
    "negative-texel": StiffCase("a negative texel", lambda: _with_texel(-0.5), refused="1 below 0"),
}
