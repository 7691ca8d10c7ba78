"""Which pixels of a candidate are not judged, and why."""

import numpy as np

from lightmeter.candidates.handed import Handed
from lightmeter.scenes.model import Scene


def left_out(scene: Scene, shapes: np.ndarray, handed: Handed) -> dict[str, np.ndarray]:
    """Reason to (H, W) bool: pixels whose centre shows what is not to be judged. Reasons without a pixel are absent.

    Args:
        shapes: (H, W) index into `Scene.shapes` of what each pixel's centre shows, −1 for none.
    """
    asked = handed.unsupported
    found: dict[str, np.ndarray] = {}

    def leave(reason: str, pixels: np.ndarray) -> None:
        if pixels.any():
            found[reason] = found[reason] | pixels if reason in found else pixels

    for index, shape in enumerate(scene.shapes):
        here = shapes == index
        material = shape.material
        for extension in material.left_out if handed.candidate.source == "file" else ():  # exports do not have them
            leave(f"{extension} of material {material.name} is not read", here)
        if material.name in asked.materials:
            leave(f"material {material.name} is not supported by the engine", here)
        if shape.name in asked.objects:
            leave(f"object {shape.name} is not supported by the engine", here)
    if asked.background:
        leave("background", shapes < 0)
    if "unsupported" in handed.layers:
        leave("the engine's layer unsupported", handed.layers["unsupported"][1][..., 0] > 0)
    return found
