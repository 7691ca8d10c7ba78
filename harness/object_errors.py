"""Which object of the scene holds the frame's error."""

from collections.abc import Callable

import numpy as np

from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.flip import ldr_flip
from lightmeter.metrics.objects import by_object
from lightmeter.reports.results import ObjectError
from lightmeter.scenes.model import Scene

BACKGROUND = "background"


def object_errors(
    scene: Scene,
    shapes: np.ndarray,
    frame: np.ndarray,
    reference: np.ndarray,
    display: Callable[[np.ndarray], np.ndarray],
) -> tuple[ObjectError, ...]:
    """Every object that is seen, the one with the largest share first.

    Args:
        shapes: (H, W) index into `Scene.shapes` of what each pixel's centre shows, -1 for none.
        frame: (H, W, 3) scene-linear.
        reference: K batches of (H, W, 3).
        display: the frame's display transform, for FLIP.
    """
    comparison = Comparison(frame, reference)
    flips = ldr_flip(display(frame), display(comparison.mean_reference.astype(np.float32)))
    found = [
        ObjectError(*_names(scene, index), part.pixels, part.metrics, part.share)
        for index, part in by_object(comparison, shapes, flips).items()
    ]
    return tuple(sorted(found, key=lambda item: -item.share.value))


def _names(scene: Scene, index: int) -> tuple[str, str]:
    """The object's and its material's name."""
    if index < 0:
        return BACKGROUND, ""
    shape = scene.shapes[index]
    return shape.name, shape.material.name
