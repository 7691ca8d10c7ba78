"""The cylinder and the cone: a slanted wall around the Y axis, and its lids."""

import numpy as np

from lightmeter.scenes.model import Mesh
from lightmeter.scenes.shapes.disk import disk
from lightmeter.scenes.shapes.lattice import joined, lattice, turn
from lightmeter.scenes.shapes.limits import ALONG, AROUND, check_length, check_steps


def cylinder(radius: float = 1.0, height: float = 1.0, segments: int = 48, rings: int = 1, caps: bool = True) -> Mesh:
    """A cylinder around the Y axis, centred at the origin, with sharp rims.

    Args:
        radius, height: metres.
        segments: steps around the axis, 3…1024.
        rings: steps along it, 1…1024.
        caps: whether it is closed at both ends.

    Returns:
        An image on the wall stands upright, its middle facing +Z. The caps have the whole texture each.

    Raises:
        SceneError: a parameter is out of range.
    """
    radius, height = check_length("radius", radius), check_length("height", height)
    segments, rings = check_steps("segments", segments, AROUND), check_steps("rings", rings, ALONG)
    wall = _wall(radius, radius, height, segments, rings)
    if not caps:
        return wall
    lid = disk(radius, segments)
    return joined(wall, _lifted(lid, height / 2), _lowered(lid, height / 2))


def cone(radius: float = 1.0, height: float = 1.0, segments: int = 48, rings: int = 8, cap: bool = True) -> Mesh:
    """A cone around the Y axis, centred at the origin, its tip up, with a sharp rim.

    Args:
        radius, height: metres.
        segments: steps around the axis, 3…1024.
        rings: steps from the tip down, 1…1024.
        cap: whether its base is closed.

    Returns:
        An image on the wall stands upright, its middle facing +Z. The tip is a vertex per segment, with the
        normal of that segment's middle.

    Raises:
        SceneError: a parameter is out of range.
    """
    radius, height = check_length("radius", radius), check_length("height", height)
    segments, rings = check_steps("segments", segments, AROUND), check_steps("rings", rings, ALONG)
    wall = _wall(0.0, radius, height, segments, rings)
    return joined(wall, _lowered(disk(radius, segments), height / 2)) if cap else wall


def _wall(top: float, bottom: float, height: float, segments: int, rings: int) -> Mesh:
    """The wall between a circle of radius `top` at +height/2 and one of radius `bottom` at −height/2."""
    texcoords, triangles = lattice(segments, rings)
    down = np.repeat(np.arange(rings + 1) / rings, segments + 1)
    sin_turn, cos_turn = (np.tile(values, rings + 1) for values in turn(segments))
    radii = top + (bottom - top) * down
    positions = np.stack([-radii * sin_turn, height * (0.5 - down), -radii * cos_turn], axis=1)
    if top == 0:  # the first row is the tip: a vertex per segment, at that segment's middle
        half, tip = len(triangles) // 2, slice(0, segments + 1)
        triangles = np.concatenate([triangles[:half], triangles[half + segments :]])
        texcoords[tip, 0] += 0.5 / segments
        middle = 2 * np.pi * texcoords[tip, 0]
        sin_turn[tip], cos_turn[tip] = np.sin(middle), np.cos(middle)
    out, up = np.array([height, bottom - top]) / np.hypot(height, bottom - top)
    normals = np.stack([-out * sin_turn, np.full_like(sin_turn, up), -out * cos_turn], axis=1)
    return Mesh(positions, triangles, normals, (texcoords,))


def _lifted(lid: Mesh, by: float) -> Mesh:
    return Mesh(lid.positions + np.array([0, by, 0]), lid.triangles, lid.normals, lid.texcoords)


def _lowered(lid: Mesh, by: float) -> Mesh:
    """The lid lowered and facing −Y, its rim the same as the upper one's bit by bit."""
    return Mesh(
        positions=lid.positions - np.array([0, by, 0]),
        triangles=lid.triangles[:, ::-1],
        normals=np.tile((0.0, -1.0, 0.0), (len(lid.positions), 1)),
        texcoords=(lid.texcoords[0] * (1, -1) + (0, 1),),
    )
