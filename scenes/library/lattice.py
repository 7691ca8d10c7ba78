"""Bars of a centimetre or two, layer behind layer, over a ground: what a depth buffer knows least about."""

import numpy as np

from lightmeter.scenes import shapes
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.model import Camera, DirectionalLight, Environment, Material, Scene, Shape
from lightmeter.scenes.toml.placing import unit

SUMMARY = "Thin bars in layers over a floor: what lies behind them is hidden from the screen, and not from the sky."
BARS, SPREAD = 13, 1.2


def scene() -> Scene:
    """Two layers of crossed bars, 2 and 1 cm wide, and a fence of upright ones; a ball stands behind the fence."""
    ground = Material("ground", (0.6, 0.58, 0.54), roughness=0.9)
    painted = Material("painted", (0.75, 0.3, 0.2), roughness=0.5)
    steel = Material("steel", (0.56, 0.57, 0.58), metallic=1.0, roughness=0.4)
    white = Material("white", (0.8, 0.8, 0.8), roughness=0.6)

    def bar(name: str, size: tuple[float, float, float], at: tuple[float, float, float], material: Material) -> Shape:
        place = np.eye(4)
        place[:3, 3] = at
        return Shape(name, shapes.box(*size), material, place)

    offsets = np.linspace(-SPREAD, SPREAD, BARS)
    placed = [bar(f"along {i}", (2.6, 0.02, 0.02), (0.0, 0.5, float(z)), painted) for i, z in enumerate(offsets)]
    placed += [bar(f"across {i}", (0.01, 0.01, 2.6), (float(x), 0.62, 0.0), steel) for i, x in enumerate(offsets)]
    placed += [bar(f"post {i}", (0.02, 0.5, 0.02), (float(x), 0.25, 0.9), white) for i, x in enumerate(offsets)]
    place = np.eye(4)
    place[:3, 3] = -0.2, 0.2, 0.3
    return Scene(
        name="lattice",
        shapes=(
            Shape("ground", shapes.plane(8.0, 8.0), ground),
            Shape("ball", shapes.sphere(0.2, segments=64), white, place),
            *placed,
        ),
        camera=Camera(
            "camera", look_at((1.1, 1.25, 2.5), (0.0, 0.28, 0.1)), yfov=float(np.radians(40.0)), near=0.1, far=20.0
        ),
        lights=(DirectionalLight("sun", unit((-0.6, -1.0, -0.4)), (0.6, 0.55, 0.45)),),
        environment=Environment((0.8, 0.9, 1.0)),
        summary=SUMMARY,
    )
