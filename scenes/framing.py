"""The camera and the lights of a scene that brings none.

The camera looks at the middle of the scene from the front right and a little above, and sees the whole
bounding sphere. The light rig is a key light over the viewer's left shoulder, a dimmer and cooler fill from
the right, and a constant environment. Together they put an irradiance of about π on a surface that faces
the key light, so that a diffuse surface's radiance there is about its reflectance: a mid grey (0.18) object
comes out mid grey at exposure 0 under a filmic tone curve.
"""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.model import Camera, DirectionalLight, Environment, Shape, Vector

YFOV = np.radians(35.0)
AZIMUTH, ELEVATION = np.radians(35.0), np.radians(20.0)
MARGIN = 1.05
"""How much larger than the bounding sphere the seen sphere is."""

# Directions towards the lights in the camera's frame, their irradiance (W/m²), and the environment's radiance.
KEY_FROM, KEY = (-0.55, 0.65, 0.55), (2.4, 2.32, 2.2)
FILL_FROM, FILL = (0.85, 0.1, 0.5), (0.35, 0.42, 0.5)
SURROUND = (0.25, 0.26, 0.28)

CAMERA_NOTE = (
    "no camera given: a framed one is used (35° to the right of +Z, 20° above, 35° angle of view, fitted to the "
    "bounding sphere)"
)
LIGHTS_NOTE = (
    "nothing gives light: the default rig is used (a key light over the viewer's left shoulder, a fill from the "
    "right, a constant environment)"
)
NOTES = (CAMERA_NOTE, LIGHTS_NOTE)


def look_at(position: Vector, target: Vector, up: Vector = (0.0, 1.0, 0.0)) -> np.ndarray:
    """(4, 4) float64 camera-to-world matrix of a camera at `position` that looks at `target`.

    Where `up` is parallel to the line of sight, the nearest axis that is not takes its place.

    Raises:
        ValueError: `position` and `target` are the same point.
    """
    backward = np.subtract(position, target, dtype=np.float64)
    length = np.linalg.norm(backward)
    if not length > 0:
        raise ValueError("a camera's target is where the camera is")
    backward = backward / length
    right = np.cross(up, backward)
    if np.linalg.norm(right) < 1e-9 * np.linalg.norm(up) or not np.any(right):
        right = np.cross(np.eye(3)[np.argmin(np.abs(backward))], backward)
    right /= np.linalg.norm(right)
    out = np.eye(4)
    out[:3, :3] = np.stack([right, np.cross(backward, right), backward], axis=1)
    out[:3, 3] = position
    return out


def rigid(matrix: np.ndarray, where: str) -> np.ndarray:
    """The rotation and translation in `matrix` (4, 4): its line of sight is kept, then its up.

    Raises:
        SceneError: no line of sight is left.
    """
    matrix = np.asarray(matrix, dtype=np.float64)
    eye, backward, up = matrix[:3, 3], matrix[:3, 2], matrix[:3, 1]
    length = np.linalg.norm(backward)
    if not np.isfinite(matrix).all() or not 1e-12 < length < 1e12 or not np.linalg.norm(up) > 1e-12:
        raise SceneError("this matrix leaves a camera no direction", where=where, remedy="use a rotation")
    out = look_at((0.0, 0.0, 0.0), tuple(-backward / length), tuple(up / np.linalg.norm(up)))
    out[:3, 3] = eye
    return out


def bounding_sphere(shapes: Iterable[Shape]) -> tuple[np.ndarray, float]:
    """Middle (3,) of the bounding box in world space and the distance of the farthest vertex from it, metres.

    A scene without vertices gets the unit sphere.
    """
    clouds = [s.world.positions.astype(np.float64) for s in shapes if len(s.mesh.positions)]
    if not clouds:
        return np.zeros(3), 1.0
    low = np.min([c.min(axis=0) for c in clouds], axis=0)
    high = np.max([c.max(axis=0) for c in clouds], axis=0)
    middle = (low + high) / 2
    radius = max(float(np.linalg.norm(c - middle, axis=1).max()) for c in clouds)
    return middle, radius if radius > 0 else 1.0


def framed_camera(shapes: Iterable[Shape]) -> Camera:
    """A camera in three-quarter view that sees the bounding sphere in an image at least as wide as high."""
    middle, radius = bounding_sphere(shapes)
    away = np.array([np.sin(AZIMUTH) * np.cos(ELEVATION), np.sin(ELEVATION), np.cos(AZIMUTH) * np.cos(ELEVATION)])
    distance = MARGIN * radius / np.sin(YFOV / 2)
    matrix = look_at(tuple(middle + distance * away), tuple(middle))
    near, far = max(distance - 1.1 * radius, 0.01 * distance), distance + 1.1 * radius
    return Camera("framed", matrix, yfov=float(YFOV), near=float(near), far=float(far))


def clipping_distances(shapes: Iterable[Shape], matrix: np.ndarray) -> tuple[float, float]:
    """Near and far distances, metres, that hold every vertex in front of a camera; far is at most 10⁴ near."""
    clouds = [s.world.positions for s in shapes if len(s.mesh.positions)]
    if not clouds:
        return 0.01, 100.0
    depths = np.concatenate([(cloud - matrix[:3, 3]) @ -matrix[:3, 2] for cloud in clouds])
    far = max(1.01 * float(depths.max()), 1e-3)
    near = max(0.99 * float(depths.min()), 1e-4 * far)
    return near, far


def gives_light(shapes: Iterable[Shape]) -> bool:
    """Whether a shape lights the scene: one that emits evenly.

    Emission through a texture is taken for a detail, such as a lamp or a screen on a model.
    """
    return any(s.material.emits and s.material.emissive_texture is None for s in shapes)


def default_lights(camera: Camera) -> tuple[tuple[DirectionalLight, ...], Environment]:
    """The rig, turned with the camera: a key light, a fill light, and the environment."""

    def light(name: str, towards: Vector, irradiance: Vector) -> DirectionalLight:
        direction = -(camera.matrix[:3, :3] @ np.array(towards))
        x, y, z = direction / np.linalg.norm(direction)
        return DirectionalLight(name, (float(x), float(y), float(z)), irradiance)

    return (light("key", KEY_FROM, KEY), light("fill", FILL_FROM, FILL)), Environment(SURROUND)


def rolled(camera: Camera, degrees: float) -> Camera:
    """The camera turned about its own axis, anticlockwise as seen by itself."""
    angle = np.radians(degrees)
    turn = np.eye(4)
    turn[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    return replace(camera, matrix=camera.matrix @ turn)
