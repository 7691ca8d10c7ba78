"""What is seen where there is no surface: the environment."""

import numpy as np

from lightmeter.scenes.model import Scene

from .device import Device
from .shaders import source
from .uniforms import Uniforms

FRAGMENT = """uniform vec3 environment_radiance;
out vec4 radiance;
void main() { radiance = vec4(environment_radiance, 0.0); }
"""


class Background:
    """Fills in the environment's radiance behind everything, by the depth test."""

    def __init__(self, device: Device, scene: Scene, radiance, depth) -> None:
        self._device = device
        self._target = device.framebuffer([radiance], depth)
        program = device.program(source(FRAGMENT))
        colour = scene.environment.radiance if scene.environment else (0.0, 0.0, 0.0)
        self._uniforms = Uniforms(program, {"environment_radiance": np.array(colour)})
        self._vertices = device.fullscreen(program)

    def draw(self) -> None:
        """Draw where the depth is still the greatest."""
        gl = self._device.gl
        self._target.use()
        gl.enable_only(gl.DEPTH_TEST)
        gl.depth_func = "<="
        self._uniforms.write()
        self._device.draw(self._vertices, 3)
        gl.depth_func = "<"
