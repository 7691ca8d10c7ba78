"""The environment's map on the device."""

import numpy as np

from lightmeter.scenes.model import Environment

from .device import Device


class EnvironmentMap:
    """A latitude-longitude map as a texture, row 0 first; `environment_map.glsl` looks it up.

    Attributes:
        textures: by the sampler's name.
    """

    def __init__(self, device: Device, environment: Environment) -> None:
        assert environment.map is not None, "a constant environment needs no texture"
        texels = environment.map.texels
        height, width = texels.shape[:2]
        texture = device.gl.texture((width, height), 3, np.ascontiguousarray(texels).tobytes(), alignment=1, dtype="f4")
        device.counts["textures"] += 1
        texture.filter = (device.gl.NEAREST, device.gl.NEAREST)
        self.textures = {"environment_map": texture}
