"""The frame's time over the number of point lights: with a range they cost what they touch, without one the picture."""

import math

import numpy as np
from figures import Figure

from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes import shapes
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.model import Camera, Material, PointLight, Scene, Shape

COUNTS = (1, 4, 16, 64, 256, 1024)
MOST_UNLIMITED = 64
SIZE = (512, 512)
FRAMES = 10
SIDE = 8.0
"""Metres along the floor that the lights stand over."""


def hall(count: int, reach: float | None) -> Scene:
    """A floor with some balls under lights spread evenly, 0.3 m above it."""
    rng = np.random.default_rng(count)
    columns = math.ceil(math.sqrt(count))
    cells = np.stack(np.meshgrid(np.arange(columns), np.arange(columns)), axis=-1).reshape(-1, 2)[:count]
    places = ((cells + rng.uniform(0.2, 0.8, cells.shape)) / columns - 0.5) * SIDE
    colours = rng.uniform(0.2, 1.0, (count, 3)) * (6.0 / columns**2)
    lights = tuple(
        PointLight(f"light {i}", (float(x), 0.3, float(z)), tuple(map(float, colour)), reach)
        for i, ((x, z), colour) in enumerate(zip(places, colours, strict=True))
    )
    made = [Shape("floor", shapes.plane(SIDE, SIDE), Material("floor", (0.6, 0.6, 0.6), roughness=0.6))]
    ball = shapes.sphere(0.25, 24)
    for i in range(16):
        matrix = np.eye(4)
        matrix[:3, 3] = (i % 4 - 1.5) * 2, 0.25, (i // 4 - 1.5) * 2
        made.append(Shape(f"ball {i}", ball, Material("ball", (0.8, 0.7, 0.5), 1.0, roughness=0.4), matrix))
    camera = Camera("above", look_at((0, 5, 7), (0, 0, 0.4)), yfov=0.95, near=0.1, far=30.0)
    return Scene("hall", tuple(made), camera, lights)


def measure(device: Device) -> list[Figure]:
    """The frame without shadows: lights that end after 1 m, ever denser, and unlimited ones."""
    figures = []
    for reach in (1.0, None):
        for count in COUNTS:
            if reach is None and count > MOST_UNLIMITED:
                continue
            choice = Choice(only=("cook_torrance",))
            renderer = Renderer(device, compile_plan(hall(count, reach), effects(), choice), SIZE)
            frame = renderer.measure(FRAMES).frame
            name = f"{count} lights, {'unlimited' if reach is None else f'range {reach:g} m'}"
            note = f"± {frame.mad:.2f}; {frame.median / count:.3f} ms a light"
            figures.append(Figure(name, frame.median, "ms", None, note))
    return figures
