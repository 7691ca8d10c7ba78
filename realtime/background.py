"""What is seen where there is no surface: the environment."""

import numpy as np

from lightmeter.scenes.model import Camera, Environment, Scene

from .device import Device
from .environment_map import EnvironmentMap
from .projection import projection_matrix
from .shaders import source
from .uniforms import Uniforms, bind, set_uniforms

CONSTANT = """uniform vec3 environment_radiance;
out vec4 radiance;
void main() { radiance = vec4(environment_radiance, 0.0); }
"""

MAP = """#include "environment_map.glsl"
uniform vec2 image_size;
uniform mat4 world_from_clip; // of directions: the camera stands at the origin
uniform vec3 parallel;        // where all of an orthographic camera's rays go, else 0
out vec4 radiance;
void main() {
    vec4 far = world_from_clip * vec4(gl_FragCoord.xy / image_size * 2.0 - 1.0, 1.0, 1.0);
    vec3 direction = parallel == vec3(0.0) ? normalize(far.xyz / far.w) : parallel;
    radiance = vec4(environment_towards(direction), 0.0);
}
"""


class Background:
    """Fills in the environment's radiance behind everything, by the depth test."""

    def __init__(self, device: Device, scene: Scene, size: tuple[int, int], radiance, depth) -> None:
        assert scene.environment is not None, "without one there is nothing to draw"
        self._device, self._camera, self._size = device, scene.camera, size
        self._target = device.framebuffer([radiance], depth)
        self._map = EnvironmentMap(device, scene.environment) if scene.environment.map else None
        self._program = device.program(source(MAP if self._map else CONSTANT))
        self._uniforms = Uniforms(self._program, _uniforms(scene.environment, scene.camera, size))
        self._vertices = device.fullscreen(self._program)

    def draw(self, offset: tuple[float, float] = (0.0, 0.0)) -> None:
        """Draw where the depth is still the greatest, as seen `offset` pixels right and down from the centres."""
        gl = self._device.gl
        self._target.use()
        gl.enable_only(gl.DEPTH_TEST)
        gl.depth_func = "<="
        self._uniforms.write()
        if self._map is not None:
            set_uniforms(self._program, {"world_from_clip": _directions(self._camera, self._size, offset)})
            bind(self._program, self._map.textures)
        self._device.draw(self._vertices, 3)
        gl.depth_func = "<"


def _uniforms(environment: Environment, camera: Camera, size: tuple[int, int]) -> dict[str, object]:
    forward = -camera.matrix[:3, 2] / np.linalg.norm(camera.matrix[:3, 2])
    return {
        "environment_radiance": np.array(environment.radiance),
        "environment_rotation": environment.rotation,
        "image_size": np.array(size),
        "parallel": np.zeros(3) if camera.yfov is not None else forward,
    }


def _directions(camera: Camera, size: tuple[int, int], offset: tuple[float, float]) -> np.ndarray:
    """(4, 4): from clip space to world space about the camera's own place."""
    turned = np.eye(4)
    turned[:3, :3] = camera.matrix[:3, :3]
    return turned @ np.linalg.inv(projection_matrix(camera, size, offset))
