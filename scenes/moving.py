"""A scene somewhere else, or of another size: nothing that is seen of it changes, only the coordinates that hold it."""

from dataclasses import replace

import numpy as np

from lightmeter.scenes.model import DirectionalLight, Material, PointLight, Scene, SpotLight


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


def scaled(scene: Scene, by: float) -> Scene:
    """The scene with every length multiplied, the camera's included, and every radiance as it was.

    Irradiance falls with the square of distance, so that point lights' intensities grow with the square of `by`. A
    power of two scales every float32 without rounding.

    Args:
        by: above 0.
    """
    larger = np.diag((by, by, by, 1.0))
    lights = tuple(light if isinstance(light, DirectionalLight) else _scaled_light(light, by) for light in scene.lights)
    camera, matrix = scene.camera, scene.camera.matrix.copy()
    matrix[:3, 3] *= by
    return replace(
        scene,
        shapes=tuple(
            replace(shape, matrix=larger @ shape.matrix, material=_scaled_inside(shape.material, by))
            for shape in scene.shapes
        ),
        camera=replace(
            camera,
            matrix=matrix,
            near=camera.near * by,
            far=camera.far * by,
            ymag=None if camera.ymag is None else camera.ymag * by,
        ),
        lights=lights,
    )


def _scaled_inside(material: Material, by: float) -> Material:
    """What a solid absorbs over a length that is multiplied."""
    if not max(material.absorption) > 0:
        return material
    red, green, blue = (value / by for value in material.absorption)
    return replace(material, absorption=(red, green, blue))


def _scaled_light(light: PointLight | SpotLight, by: float) -> PointLight | SpotLight:
    x, y, z = (float(value) * by for value in light.position)
    red, green, blue = (value * by**2 for value in light.intensity)
    ends = None if light.range is None else light.range * by
    return replace(light, position=(x, y, z), intensity=(red, green, blue), range=ends)


def _shifted(position, by: np.ndarray) -> tuple[float, float, float]:
    x, y, z = (float(a + b) for a, b in zip(position, by, strict=True))
    return x, y, z
