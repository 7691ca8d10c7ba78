"""Lights (KHR_lights_punctual), read as radiometric: W/sr and W/m² in linear Rec. 709."""

import numpy as np

from lightmeter.scenes.checks import FARTHEST
from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.gltf.document import Light, LightReference, Lights, Node
from lightmeter.scenes.gltf.source import Source
from lightmeter.scenes.model import DirectionalLight, PointLight, PunctualLight, SpotLight

NAME = "KHR_lights_punctual"


class Punctuals:
    """The lights of one file."""

    def __init__(self, source: Source):
        self._source = source
        found = source.extension(source.document, NAME, Lights, "")
        self._lights = found.lights if found else []

    def at(self, node: Node, index: int, world: np.ndarray) -> PunctualLight | None:
        """The light at a node, if it has one.

        Raises:
            SceneError: it refers to a light that is not there, or its node has no direction.
        """
        source = self._source
        place = f"nodes[{index}]"
        reference = source.extension(node, NAME, LightReference, place)
        if reference is None:
            return None
        light = source.get(f"extensions.{NAME}.lights", self._lights, reference.light, place)
        name = light.name or node.name or f"light {reference.light}"
        source.note(
            "light intensities are read as W/sr and W/m², where glTF says candela and lux (683 times as many "
            "at 555 nm); change the camera's exposure if the picture is too bright"
        )
        return _placed(light, name, world, source.at(place))


def _placed(light: Light, name: str, world: np.ndarray, where: str) -> PunctualLight:
    red, green, blue = (channel * light.intensity for channel in light.color)
    x, y, z = (float(value) for value in world[:3, 3])
    # What no scene reaches is no limit; and a range's square must not vanish.
    limit = None if light.range is None or light.range > FARTHEST else max(light.range, 1 / FARTHEST)
    if light.type == "point":
        return PointLight(name, (x, y, z), (red, green, blue), limit)
    forward = -world[:3, 2]
    length = np.linalg.norm(forward)
    if not 1e-12 < length < 1e12:
        raise SceneError("the light has no direction", where=where, remedy="its node is scaled to nothing")
    u, v, w = (float(value) for value in forward / length)
    if light.type == "directional":
        return DirectionalLight(name, (u, v, w), (red, green, blue))
    assert light.spot is not None
    inner, outer = light.spot.inner, min(light.spot.outer, np.pi / 2)
    return SpotLight(name, (x, y, z), (u, v, w), (red, green, blue), inner, outer, limit)
