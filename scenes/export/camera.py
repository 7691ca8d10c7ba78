"""camera.json: what an engine needs to draw the picture that is compared, with every convention spelled out."""

from dataclasses import asdict
from typing import Any

import numpy as np

from ..model import AreaLight, Camera, DirectionalLight, Light, Scene, SpotLight
from ..projection import clip_from_camera

SCHEMA = 1
ENVIRONMENT_FILE = "environment.exr"

CONVENTIONS = {
    "axes": "Y is up; a camera looks along its own -Z, with +X to its right and +Y up",
    "handedness": "right-handed, in the world and in camera space",
    "matrices": (
        "lists of rows, to be multiplied with column vectors from the left: clip = clip_from_camera * "
        "camera_from_world * (x, y, z, 1). Clip space is OpenGL's: x to the right, y up, z/w from -1 (near) to 1 (far)"
    ),
    "pixel_centres": (
        "pixel (column, row) has its centre at (column + 0.5, row + 0.5); (0, 0) is the image's top left corner: "
        "column + 0.5 = (1 + x/w) * width / 2, row + 0.5 = (1 - y/w) * height / 2. A pixel's true value is the "
        "mean over its square"
    ),
    "rows": "the top row comes first",
    "units": "metres, radians, W/(sr*m^2), W/sr, W/m^2; exposure in stops",
    "colour": (
        "scene-linear RGB with the primaries and white of Rec. 709: radiance before exposure and display transform, "
        "with the background's share of a pixel in it. Alpha, if any, is coverage, and not multiplied into the colour"
    ),
    "lights": (
        "glTF's intensity times colour is meant in W/sr (point, spot) and W/m^2 (directional), RGB, not in candela "
        "or lux. Radiance reflected by a white diffuse surface is irradiance / pi. Light falls off with the squared "
        "distance d, times 1 - (d/range)^4 up to the range and nothing beyond, where it has one; a spot's cone as in "
        "KHR_lights_punctual. A directional light's direction is the way the light travels. Every light casts shadows. "
        "Area lights are the emissive surfaces"
    ),
    "materials": (
        "glTF 2.0 metallic-roughness (Appendix B) with alpha = max(roughness^2, 0.001), single scattering, index of "
        "refraction 1.5. The back of a single-sided material is opaque and black, and casts shadows. Emission leaves "
        "the front, or both sides of a double-sided material; emissiveFactor times emissiveStrength is in W/(sr*m^2). "
        "A mesh without normals is flat. The truth traces occlusion and does not read the occlusion texture"
    ),
    "environment": (
        "latitude-longitude, radiance: a direction (x, y, z) of length 1 lies at u = 0.5 + atan2(z, x) / (2 pi) of the "
        "width, from the left, and v = acos(y) / pi of the height, from the top. It lights the scene and is "
        "seen behind it; without one the background is black"
    ),
    "depth_layer": "metres along the camera's forward axis from its position (not along the ray, and not 0 to 1)",
    "normal_layer": "the shading normal in world space, of length 1; a double-sided material's is turned to the viewer",
}


def camera_document(scene: Scene, size: tuple[int, int]) -> dict[str, Any]:
    """The JSON document for an image of `size`, width and height in pixels.

    `lights` holds `scene.all_lights` in their order: a light's index numbers the layers that speak of it.
    """
    environment = None
    if scene.environment is not None:
        constant = None if scene.environment.map else list(scene.environment.radiance)
        environment = {"file": ENVIRONMENT_FILE, "radiance": constant}
    return {
        "schema": SCHEMA,
        "scene": scene.name,
        "size": list(size),
        "camera": _camera(scene.camera, size),
        "exposure": scene.camera.exposure,
        "metering": None if scene.camera.metering is None else asdict(scene.camera.metering),
        "aperture": None if scene.camera.aperture is None else asdict(scene.camera.aperture),
        "max_depth": scene.max_depth,
        "environment": environment,
        "lights": [_light(scene, light, index) for index, light in enumerate(scene.all_lights)],
        "conventions": dict(CONVENTIONS),
    }


def _camera(camera: Camera, size: tuple[int, int]) -> dict[str, Any]:
    return {
        "kind": "perspective" if camera.yfov is not None else "orthographic",
        "yfov": camera.yfov,
        "ymag": camera.ymag,
        "aspect": size[0] / size[1],
        "near": camera.near,
        "far": camera.far,
        "position": camera.position.tolist(),
        "forward": (-camera.matrix[:3, 2]).tolist(),
        "up": camera.matrix[:3, 1].tolist(),
        "world_from_camera": camera.matrix.tolist(),
        "camera_from_world": np.linalg.inv(camera.matrix).tolist(),
        "clip_from_camera": clip_from_camera(camera, size).tolist(),
    }


def _light(scene: Scene, light: Light, index: int) -> dict[str, Any]:
    if isinstance(light, AreaLight):
        material = scene.shapes[light.shape].material
        return {
            "index": index,
            "kind": "area",
            "name": light.name,
            "node": light.shape,
            "radiance_w_per_sr_m2": list(light.radiance),
            "textured": material.emissive_texture is not None,
            "double_sided": material.double_sided,
        }
    if isinstance(light, DirectionalLight):
        return {
            "index": index,
            "kind": "directional",
            "name": light.name,
            "direction": list(light.direction),
            "irradiance_w_per_m2": list(light.irradiance),
        }
    placed = {
        "index": index,
        "kind": "point",
        "name": light.name,
        "position_m": list(light.position),
        "intensity_w_per_sr": list(light.intensity),
        "range_m": light.range,
    }
    if isinstance(light, SpotLight):
        placed |= {
            "kind": "spot",
            "direction": list(light.direction),
            "inner_rad": light.inner,
            "outer_rad": light.outer,
        }
    return placed
