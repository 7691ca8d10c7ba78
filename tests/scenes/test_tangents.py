"""Tangents against closed forms."""

import numpy as np
import pytest

from lightmeter.scenes import shapes
from lightmeter.scenes.model import Mesh
from lightmeter.scenes.tangents import duff_tangent, unwelded, with_tangents

SQUARE = np.float32([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
TWO = np.array([[0, 1, 2], [0, 2, 3]])
UP = np.float32([[0, 0, 1]] * 4)
UPRIGHT = np.float32([[0, 1], [1, 1], [1, 0], [0, 0]])


def test_a_sphere_has_the_tangents_of_its_longitude():
    """Away from the poles the tangent is dP/du, so it is level and lies across the normal."""
    mesh = with_tangents(shapes.sphere(2.0, 96, 48))
    body = np.abs(mesh.normals[:, 1]) < 0.98
    east = np.cross([0, 1, 0], mesh.normals[body].astype(np.float64))
    east /= np.linalg.norm(east, axis=1, keepdims=True)
    cosines = np.sum(mesh.tangents[body, :3] * east, axis=1)
    at_seam = np.isin(mesh.texcoords[0][body, 0], (0, 1))  # triangles on one side only: half a step off
    assert cosines[~at_seam].min() > np.cos(np.radians(0.5))
    assert cosines.min() > np.cos(np.radians(1.9))
    assert (mesh.tangents[:, 3] == 1).all()
    np.testing.assert_allclose(np.linalg.norm(mesh.tangents[:, :3], axis=1), 1, atol=1e-6)
    np.testing.assert_allclose(np.sum(mesh.tangents[:, :3] * mesh.normals, axis=1), 0, atol=1e-6)


def test_a_seam_whose_two_sides_agree_is_smooth():
    """Only what agrees in position, normal and texture coordinate is averaged; a torus still comes out true."""
    mesh = with_tangents(shapes.torus(1.0, 0.3, 64, 32))
    level = np.stack([-mesh.positions[:, 2], np.zeros(len(mesh.positions)), mesh.positions[:, 0]], axis=1)
    level /= -np.linalg.norm(level, axis=1, keepdims=True)
    u = mesh.texcoords[0][:, 0]
    inner = (u > 0.01) & (u < 0.99)
    assert np.sum(mesh.tangents[:, :3] * level, axis=1)[inner].min() > 0.9999
    assert np.sum(mesh.tangents[:, :3] * level, axis=1).min() > 0.99


@pytest.mark.parametrize("degrees", [0, 30, 90, 200])
def test_turned_texture_coordinates_turn_the_tangent(degrees):
    """Closed form: for uv = R·(x, 1 − y), u grows along R's first row, in a plane with y up."""
    angle = np.radians(degrees)
    right, up = np.cos(angle), np.sin(angle)
    uv = UPRIGHT @ np.array([[right, up], [-up, right]], np.float32)  # u = right·x − up·(1 − y)
    mesh = with_tangents(Mesh(SQUARE, TWO, UP, (uv,)))
    np.testing.assert_allclose(mesh.tangents, [[right, up, 0, 1]] * 4, atol=1e-6)


def test_a_sheared_image_keeps_the_direction_of_growing_u():
    """u = x, v = 1 − y + x: at constant v the point moves along (1, 1)."""
    uv = np.stack([SQUARE[:, 0], 1 - SQUARE[:, 1] + SQUARE[:, 0]], axis=1)
    mesh = with_tangents(Mesh(SQUARE, TWO, UP, (uv,)))
    half = np.sqrt(0.5)
    np.testing.assert_allclose(mesh.tangents, [[half, half, 0, 1]] * 4, atol=1e-6)


def test_a_mirrored_image_has_the_other_sign():
    mesh = with_tangents(Mesh(SQUARE, TWO, UP, (UPRIGHT * (-1, 1) + (1, 0),)))
    np.testing.assert_allclose(mesh.tangents, [[-1, 0, 0, -1]] * 4, atol=1e-6)


def test_a_mirror_seam_doubles_its_vertices():
    """Two squares side by side, the right one the mirror image of the left: u falls from x = 0 on."""
    positions = np.float32([[-1, 0, 0], [0, 0, 0], [1, 0, 0], [-1, 1, 0], [0, 1, 0], [1, 1, 0]])
    uv = np.stack([1 - np.abs(positions[:, 0]), 1 - positions[:, 1]], axis=1)
    triangles = [[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]]
    mesh = with_tangents(Mesh(positions, triangles, [[0, 0, 1]] * 6, (uv,)))
    assert len(mesh.positions) == 8
    np.testing.assert_array_equal(mesh.positions[mesh.triangles], positions[np.array(triangles)])
    np.testing.assert_allclose(mesh.tangents[mesh.triangles[:2].ravel()], [[1, 0, 0, 1]] * 6, atol=1e-6)
    np.testing.assert_allclose(mesh.tangents[mesh.triangles[2:].ravel()], [[-1, 0, 0, -1]] * 6, atol=1e-6)


def test_corners_are_weighted_by_their_angle():
    """Three triangles around a vertex with angles 90°, 45° and 45°: the sum weighted so, normalised."""
    positions = np.float32([[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 1, 0], [-1, 0, 0]])
    triangles = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4]])
    apart = positions[triangles].reshape(-1, 3)
    turns = np.radians([0, 40, -70])
    uv = np.concatenate(
        [
            np.stack([c[:, 0] * np.cos(t) + c[:, 1] * np.sin(t), c[:, 0] * np.sin(t) - c[:, 1] * np.cos(t)], axis=1)
            for c, t in zip(positions[triangles].astype(np.float64), turns, strict=True)
        ]
    )
    uv -= uv[[0, 0, 0, 3, 3, 3, 6, 6, 6]]  # the shared corner has uv (0, 0) in all three
    mesh = with_tangents(Mesh(apart, np.arange(9).reshape(3, 3), [[0, 0, 1]] * 9, (uv,)))
    weights = np.radians([90, 45, 45])
    expected = np.array([weights @ np.cos(turns), weights @ np.sin(turns), 0])
    expected /= np.linalg.norm(expected)
    np.testing.assert_allclose(mesh.tangents[[0, 3, 6], :3], [expected] * 3, atol=1e-6)


REFERENCE = np.array(
    [  # vertex, x, y, z, w
        (0, -0.7713623, 0.46996996, 0.42910182, -1),
        (1, -0.91939831, 0.3476997, 0.18387964, -1),
        (1, 0.93727469, 0.29389924, -0.18745494, 1),
        (2, 0.91790789, 0.25326252, 0.30545574, 1),
        (3, -0.84496152, 0.48323163, 0.2291881, -1),
        (4, -0.91985571, 0.3813192, -0.09198559, -1),
        (4, 0.95545727, 0.27923506, 0.09554575, 1),
        (5, 0.82292217, 0.22717522, 0.5207597, 1),
        (6, -0.88487983, 0.4657262, -0.00931449, -1),
        (7, -0.85236579, 0.39651999, -0.34094629, -1),
        (7, 0.89893079, 0.25026235, 0.35957229, 1),
        (8, 0.7145797, 0.20491786, 0.66886806, 1),
    ]
)
"""What the reference implementation gives for `saddle()`: Mikkelsen's `mikktspace.c` as ported in mikktspace 1.1.1
(npm), with w negated, since a glTF image's v points down."""


def saddle() -> Mesh:
    """Eight triangles of z = 0.3 x² + 0.4 xy under a sheared, bent image that is mirrored at x = 0."""
    x, y = (values.ravel() for values in np.meshgrid([-1.0, 0.0, 0.75], [-0.5, 0.25, 1.0]))
    normals = np.stack([-0.6 * x - 0.4 * y, -0.4 * x, np.ones(9)], axis=1)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    uv = np.stack([np.abs(x) + 0.3 * y + 0.2 * y * y, 0.4 * x * x - y], axis=1)
    triangles = [[0, 1, 4], [0, 4, 3], [1, 2, 4], [2, 5, 4], [3, 4, 7], [3, 7, 6], [4, 5, 8], [4, 8, 7]]
    return Mesh(np.stack([x, y, 0.3 * x * x + 0.4 * x * y], axis=1), triangles, normals, (uv,))


def test_tangents_are_those_of_the_reference_implementation():
    """The port works in float32: a unit vector of up to six weighted ones, each of some ten roundings."""
    given = saddle()
    mesh = with_tangents(given)
    found = np.unique(np.c_[given.triangles.ravel(), mesh.tangents[mesh.triangles].reshape(-1, 4)], axis=0)
    assert len(found) == len(REFERENCE)
    np.testing.assert_array_equal(found[:, [0, 4]], REFERENCE[:, [0, 4]])
    np.testing.assert_allclose(found[:, 1:4], REFERENCE[:, 1:4], atol=16 * 2.0**-24)


def test_without_a_gradient_the_frame_of_duff_et_al_takes_its_place():
    mesh = with_tangents(Mesh(SQUARE, TWO, UP, (np.zeros((4, 2)),)))
    np.testing.assert_allclose(mesh.tangents, [[1, 0, 0, 1]] * 4, atol=1e-6)
    normals = np.random.default_rng(1).normal(size=(1000, 3))
    normals[:3] = [[0, 0, -1], [0, 0, 1], [1e-9, 0, -1]]
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    tangents = duff_tangent(normals)
    np.testing.assert_allclose(np.linalg.norm(tangents, axis=1), 1, atol=1e-12)
    np.testing.assert_allclose(np.sum(tangents * normals, axis=1), 0, atol=1e-12)


def test_a_mirroring_matrix_keeps_the_bitangent_on_the_image():
    """In world space the bitangent is the matrix times the local one, though both cross products turn."""
    from lightmeter.scenes.model import Material, Shape

    mesh = with_tangents(Mesh(SQUARE, TWO, UP, (UPRIGHT,)))
    matrix = np.diag([-2.0, 3.0, 1.0, 1.0])
    world = Shape("s", mesh, Material(), matrix).world
    bitangent = world.tangents[:, 3:] * np.cross(world.normals, world.tangents[:, :3])
    np.testing.assert_allclose(bitangent, [[0, 1, 0]] * 4, atol=1e-6)
    np.testing.assert_allclose(world.tangents[:, :3], [[-1, 0, 0]] * 4, atol=1e-6)


def test_unwelded_gives_each_triangle_its_own_normal():
    box = shapes.box(1, 2, 3)
    flat = unwelded(Mesh(box.positions, box.triangles, texcoords=box.texcoords))
    np.testing.assert_allclose(flat.normals, box.normals[box.triangles.ravel()], atol=1e-6)


def test_what_is_missing_is_said():
    with pytest.raises(ValueError, match="normals"):
        with_tangents(Mesh(SQUARE, TWO, texcoords=(UPRIGHT,)))
    with pytest.raises(ValueError, match="texture coordinates 1"):
        with_tangents(Mesh(SQUARE, TWO, UP, (UPRIGHT,)), 1)
