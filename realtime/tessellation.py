"""What effects share that draw a shape of few triangles where the truth has the shape itself."""

from lightmeter.scenes.model import Scene
from lightmeter.scenes.true_surface import FINE, has_true_surface

from .effect import Knob

PART = "shape"
"""The part of the G-buffer's points that they change."""

TESSELLATION = Knob(
    "tessellation",
    32,
    "Steps around the axis of every sphere, torus and cylinder; half as many from pole to pole and around the tube.",
    unit="steps",
    low=3,
    high=FINE,
    sweep=(8, 16, 32, 64, 128),
)


def without_form(scene: Scene) -> str:
    """Why a scene does not need them: it has no shape that is more than its triangles."""
    return "" if has_true_surface(scene) else "no shape of the scene is more than its triangles"
