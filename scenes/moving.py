"""A scene somewhere else in the world: nothing that is seen of it changes, only the coordinates that hold it."""

from dataclasses import replace

import numpy as np

from lightmeter.scenes.model import DirectionalLight, Scene


def moved(scene: Scene, by: np.ndarray) -> Scene:
    """The scene with everything moved, camera and lights included, in double precision.

    Args:
        by: (3,), metres.
    """
    translation = np.eye(4)
    translation[:3, 3] = by
    lights = tuple(
        light if isinstance(light, DirectionalLight) else replace(light, position=_shifted(light.position, by))
        for light in scene.lights
    )
    return replace(
        scene,
        shapes=tuple(replace(shape, matrix=translation @ shape.matrix) for shape in scene.shapes),
        camera=replace(scene.camera, matrix=translation @ scene.camera.matrix),
        lights=lights,
    )


def _shifted(position, by: np.ndarray) -> tuple[float, float, float]:
    x, y, z = (float(a + b) for a, b in zip(position, by, strict=True))
    return x, y, z
