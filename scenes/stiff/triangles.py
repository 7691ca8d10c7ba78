"""Triangles that have no normal, no area, or another triangle in their place."""

from dataclasses import replace

import numpy as np

from lightmeter.scenes import shapes
from lightmeter.scenes.model import Material, Mesh, Scene, Shape
from lightmeter.scenes.stiff.case import StiffCase, at, room, viewer


def _mesh(corners) -> Mesh:
    positions = np.array(corners, np.float32)
    return Mesh(positions, np.arange(len(positions)).reshape(-1, 3))


def slivers() -> Scene:
    """Blades a metre long and a tenth of a micrometre wide, and a standing sheet cut into strips of a tenth of a mm."""
    blades = [[(x, 0.0, 1.0), (x + 1e-7, 0.0, 1.0), (x, 1.0, 1.0)] for x in np.linspace(-1.0, 1.0, 9)]
    x = np.linspace(0.7, 1.2, 5001)
    foot, top = (np.stack([x, np.full_like(x, y), np.zeros_like(x)], axis=1) for y in (0.0, 1.0))
    strips = np.stack([foot[:-1], foot[1:], top[1:], foot[:-1], top[1:], top[:-1]], axis=1)
    red = Material("red", (0.8, 0.2, 0.2))
    return room(
        *(Shape(name, _mesh(np.reshape(c, (-1, 3))), red) for name, c in (("blades", blades), ("strips", strips)))
    )


def no_area() -> Scene:
    """Triangles that are a point, a line, and a line that turns back; they also shine, as a light of no area."""
    points = [(0.0, 1.0, 0.5)] * 3
    line = [(-1.0, 0.5, 0.5), (0.0, 0.5, 0.5), (1.0, 0.5, 0.5)]
    back = [(-1.0, 0.7, 0.5), (1.0, 0.7, 0.5), (-1.0, 0.7, 0.5)]
    dull, bright = Material("dull"), Material("bright", emissive=(5.0, 5.0, 5.0))
    mesh = _mesh(points + line + back)
    return room(Shape("no area", mesh, dull), at("no area, bright", mesh, (0.0, 0.2, 0.0), bright))


def duplicates() -> Scene:
    """A box whose every vertex, and every triangle, is there twice."""
    box = shapes.box(0.6, 0.6, 0.6)
    triangles = np.concatenate([box.triangles, box.triangles + len(box.positions)])
    assert box.normals is not None
    twice = Mesh(np.tile(box.positions, (2, 1)), triangles, np.tile(box.normals, (2, 1)))
    return room(at("twice", twice, (-0.9, 0.3, 0.4)))


def coplanar() -> Scene:
    """Two sheets in one place, of different colours: neither is in front."""
    sheet = shapes.plane(1.0, 1.0)
    return room(
        at("red", sheet, (0.0, 1e-3, 1.0), Material("red", (0.8, 0.1, 0.1))),
        at("blue", sheet, (0.0, 1e-3, 1.0), Material("blue", (0.1, 0.1, 0.8))),
    )


def coplanar_reversed() -> Scene:
    """The same, named in the other order: what differs was decided by nothing else."""
    scene = coplanar()
    return replace(scene, shapes=scene.shapes[:-2] + scene.shapes[:-3:-1])


def nothing() -> Scene:
    """No shape at all: the environment alone is seen."""
    plain = room()
    return Scene("stiff", (), viewer(), plain.lights, plain.environment)


CASES = {
    "slivers": StiffCase("triangles 10⁴ and 10⁷ times as long as they are wide", slivers),
    "no-area": StiffCase("triangles without area, some of them emissive", no_area),
    "duplicates": StiffCase("every vertex and triangle twice", duplicates),
    "coplanar": StiffCase("two surfaces in one place", coplanar),
    "coplanar-reversed": StiffCase("the same two, named in the other order", coplanar_reversed, like="coplanar"),
    "no-objects": StiffCase("no shape", nothing),
}
