"""`direct` in float64 at captured points, and how far float32 may be from it.

The bound on `direct`. The inputs are the G-buffer's own float32 numbers, so that only the shader's arithmetic counts.
With k roundings of at most ε = 2⁻²³ on the longest path, the result is exact for inputs moved by k·ε:
|Δ| ≤ k·ε·(|f| + Σ |xᵢ|·|∂f/∂xᵢ|), over position, light, normal, view and the material's numbers; a vector counts with
its norm. k: the offset (1), its square (3), inversesqrt (2), the product (1), the falloffs (10 and 6.5), the light's
power (2), and the material's own 58.5 (`shared_twins.py`): 85. The view direction is normalised on the device (7
roundings) and recomputed here: it stands among the moved inputs. Derivatives are finite differences. Where float32
cannot tell the sign of n·l or n·v, either branch is right, and those pixels' radiance is below k·ε times the light's.
"""

import numpy as np

from lightmeter.scenes.model import DirectionalLight, SpotLight
from lightmeter.scenes.optics import lights, material

EPS = float(np.finfo(np.float32).eps)
ROUNDINGS = 85
STEP = 1e-6


def gltf(base_color, metallic, roughness, specular, normal, view, to_light):
    """The scene's material: f·(n·l), (3, N)."""
    return material.evaluate(material.MaterialPoint(base_color, metallic, roughness, specular), normal, view, to_light)


def exact_direct(light, source, position, normal, view, *parameters, model=gltf):
    """Unshadowed reflected radiance, (3, N) float64.

    Args:
        source: the light's position, or the direction towards it.
        parameters: base colour, metalness, roughness, specular.
        model: f·(n·l) of them, normal, view and the direction to the light.
    """
    if isinstance(light, DirectionalLight):
        power, received, to_light = light.irradiance, 1.0, source / np.linalg.norm(source, axis=0)
    else:
        power = light.intensity
        to_light, inverse_square = lights.from_position(source, position)
        received = inverse_square
        if light.range is not None:
            received = received * lights.range_window(inverse_square, light.range**2)
        if isinstance(light, SpotLight):
            cosine = -np.sum(to_light * np.array(light.direction)[:, None], axis=0)
            received = received * lights.spot_attenuation(cosine, light.inner, light.outer)
    return np.array(power)[:, None] * received * model(*parameters, normal, view, to_light)


def inputs_of(points, light) -> list[np.ndarray]:
    """Everything `exact_direct` takes, components first, float64 from the G-buffer's float32."""
    at = points.at(points.hit)
    source = -np.array(light.direction) if isinstance(light, DirectionalLight) else np.array(light.position)
    source = np.broadcast_to(source.astype(np.float32).astype(np.float64)[:, None], (3, len(at.position)))
    vectors = [a.astype(np.float64).T for a in (at.position, at.normal, at.view, at.base_color)]
    scalars = [a.astype(np.float64) for a in (at.metallic, at.roughness, at.specular)]
    return [source, *vectors, *scalars]


def bound(light, inputs, value) -> np.ndarray:
    """The bound of the module's text, (3, N)."""
    reach = np.abs(value)
    for index, given in enumerate(inputs):
        norm = np.linalg.norm(given, axis=0) if given.ndim == 2 else np.abs(given)
        step = STEP * np.maximum(norm, 1e-30)
        for component in range(len(given) if given.ndim == 2 else 1):
            moved = given.copy()
            if given.ndim == 2:
                moved[component] += step
            else:
                moved = given + step
            there = exact_direct(light, *inputs[:index], moved, *inputs[index + 1 :])
            reach = reach + np.abs(there - value) / step * norm
    return ROUNDINGS * EPS * reach + 1e-30
