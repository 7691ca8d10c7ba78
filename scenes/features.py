"""Which terms a scene has, and for those it lacks, why."""

import numpy as np

from .model import Scene, Shape

SCATTERED = ("direct", "visibility", "environment", "environment_visibility", "indirect")
"""The terms of surfaces that scatter light."""


def is_flat(shape: Shape) -> bool:
    """Whether a shape is one flat piece, shading normals included: it can neither shade nor light itself."""
    mesh = shape.world
    if len(mesh.triangles) == 0:
        return True
    a, b, c = (mesh.positions[mesh.triangles[:, i]].astype(np.float64) for i in range(3))
    faces = np.cross(b - a, c - a)
    areas = np.linalg.norm(faces, axis=1)
    normal = faces[np.argmax(areas)] / max(areas.max(), 1e-300)
    size = np.ptp(mesh.positions, axis=0).max()
    heights = (mesh.positions - a[np.argmax(areas)]) @ normal
    facing = np.all(faces @ normal >= -1e-6 * areas)
    smooth = mesh.normals is None or bool(np.all(np.abs(mesh.normals @ normal - 1) < 1e-5))
    mapped = shape.material.has_normal_map
    return bool(np.all(np.abs(heights) <= 1e-6 * size) and facing and smooth and not mapped)


def missing_terms(scene: Scene) -> dict[str, str]:
    """The terms that the scene does not have, each with the reason."""
    missing = {
        "surface": "every shape is rendered from the same triangles on both sides",
    }
    if not any(shape.material.is_glass for shape in scene.shapes):
        missing["transmission"] = "the scene has no dielectric solids"
    if scene.camera.aperture is None:
        missing["glare"] = "the camera has no aperture to diffract at"
    if scene.camera.metering is None:
        missing["exposure"] = "the camera's exposure is set by hand"
    shapes = [shape for shape in scene.shapes if len(shape.mesh.triangles)]
    flat = len(shapes) <= 1 and all(is_flat(shape) for shape in shapes)
    alone = "one flat shape cannot stand in its own light" if shapes else "the scene has no shapes"
    if not scene.all_lights:
        missing["direct"] = missing["visibility"] = "the scene has no lights"
    elif flat:
        missing["visibility"] = alone
    if scene.environment is None or not scene.environment.shines:
        missing["environment"] = missing["environment_visibility"] = "the scene has no environment"
    elif flat:
        missing["environment_visibility"] = alone
    if flat:
        missing["indirect"] = alone
    elif 0 <= scene.max_depth <= 2:
        missing["indirect"] = f"max_depth is {scene.max_depth}: direct light only"
    if shapes and all(shape.material.is_glass for shape in shapes):
        missing |= dict.fromkeys(SCATTERED, "every surface is a dielectric solid's, which only mirrors and refracts")
    if not any(shape.material.textures for shape in scene.shapes):
        missing["material"] = "the scene has no textures"
    return missing
