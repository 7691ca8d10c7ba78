"""Too much light, too little, too many lights, and lights where none should be."""

import numpy as np

from lightmeter.scenes import shapes
from lightmeter.scenes.model import DirectionalLight, Environment, Material, PointLight, Scene
from lightmeter.scenes.stiff.case import StiffCase, at, room

DARK = Environment((0.0, 0.0, 0.0))


def sun_and_candle() -> Scene:
    """10⁶ W/m² from above beside a candle of a tenth of a watt."""
    sun = DirectionalLight("sun", (0.0, -1.0, 0.0), (1e6, 1e6, 1e6))
    return room(lights=(sun, PointLight("candle", (0.6, 0.4, 0.8), (0.1, 0.06, 0.02))))


def one_pixel() -> Scene:
    """A square of a centimetre and a half, as bright as 10⁵, that covers about a tenth of a pixel of 24."""
    lamp = at("spark", shapes.rectangle(0.015, 0.015), (0.0, 1.2, 0.6), Material("spark", emissive=(1e5, 1e5, 1e5)))
    return room(lamp, lights=())


def thousand() -> Scene:
    """A thousand lamps in a grid over the floor."""
    places = np.stack(np.meshgrid(np.linspace(-2.5, 2.5, 40), np.linspace(-2.5, 2.5, 25)), axis=-1).reshape(-1, 2)
    lamps = [PointLight(f"lamp {i}", (float(x), 1.5, float(z)), (0.01, 0.01, 0.01)) for i, (x, z) in enumerate(places)]
    return room(lights=lamps, max_depth=2)


def _lamp_at(x: float, y: float, z: float) -> Scene:
    return room(lights=(PointLight("lamp", (x, y, z), (2.0, 2.0, 2.0)),), environment=DARK)


CASES = {
    "sun-and-candle": StiffCase("10⁶ W/m² beside a tenth of a watt", sun_and_candle),
    "one-pixel-emitter": StiffCase("a lamp smaller than a pixel", one_pixel),
    "no-lights": StiffCase("no light of any kind", lambda: room(lights=(), environment=DARK)),
    "thousand-lights": StiffCase(
        "1,000 point lights", thousand, size=(16, 16), settings=(("shadow_map", "resolution", 128),)
    ),
    "light-inside": StiffCase("a light in the middle of the ball", lambda: _lamp_at(0.0, 0.5, 0.0)),
    "light-on-surface": StiffCase("a light exactly on the floor", lambda: _lamp_at(0.8, 0.0, 0.8)),
    "light-on-vertex": StiffCase("a light exactly on the ball's top", lambda: _lamp_at(0.0, 1.0, 0.0)),
}
