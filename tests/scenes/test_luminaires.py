"""Flat pieces of meshes, and the meshes that are a rectangle, a disk or a sphere."""

import numpy as np
import pytest

from lightmeter.scenes import shapes
from lightmeter.scenes.facets import facets, is_closed
from lightmeter.scenes.luminaires import Disk, Rectangle, Sphere, recognise
from lightmeter.scenes.model import Material, Mesh, Shape

RNG = np.random.default_rng(4)


def somewhere(mirrored=False) -> np.ndarray:
    """A rigid matrix, some metres from the origin."""
    matrix = np.eye(4)
    rotation = np.linalg.qr(RNG.normal(size=(3, 3)))[0]
    rotation[0] *= np.sign(np.linalg.det(rotation)) * (-1 if mirrored else 1)
    matrix[:3, :3], matrix[:3, 3] = rotation, RNG.uniform(-3, 3, 3)
    return matrix


def placed(mesh: Mesh, matrix: np.ndarray) -> Mesh:
    return Shape("shape", mesh, Material(), matrix).world


def sheet(*polygon) -> Mesh:
    """A fan around the first corner, in the plane z = 0."""
    corners = np.array([(*xy, 0.0) for xy in polygon], np.float32)
    return Mesh(corners, np.array([[0, i, i + 1] for i in range(1, len(corners) - 1)]))


def area_vector(polygon: np.ndarray) -> np.ndarray:
    return np.cross(polygon, np.roll(polygon, -1, axis=0)).sum(axis=0) / 2


@pytest.mark.parametrize(
    ("mesh", "sizes"),
    [
        (shapes.rectangle(2, 0.5, 7), [4]),
        (shapes.plane(1, 1, 150), [4]),
        (shapes.disk(0.4, 48), [48]),
        (shapes.box(1, 2, 0.5, 3), [4] * 6),
        (shapes.cone(0.5, 1, 16, 4), [3] * 16 + [16]),
        (sheet((0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)), [3] * 4),
    ],
    ids=["rectangle", "fine plane", "disk", "box", "cone", "an L"],
)
@pytest.mark.parametrize("mirrored", [False, True])
def test_flat_pieces_become_polygons_that_cover_the_mesh(mesh, sizes, mirrored):
    """The number of corners of each; together they have the mesh's area, on the same side."""
    world = placed(mesh, somewhere(mirrored))
    found = facets(world)
    assert sorted(len(polygon) for polygon in found) == sizes
    a, b, c = (world.positions[world.triangles[:, i]].astype(np.float64) for i in range(3))
    faces = np.cross(b - a, c - a) / 2
    areas = sum(np.linalg.norm(area_vector(polygon)) for polygon in found)
    assert areas == pytest.approx(np.linalg.norm(faces, axis=1).sum(), rel=1e-5)
    np.testing.assert_allclose(sum(map(area_vector, found)), faces.sum(axis=0), atol=1e-5 * areas)


def test_a_piece_with_a_hole_comes_as_its_triangles_and_two_pieces_apart_are_two():
    ring = shapes.rectangle(3, 3, 3)
    middle = np.abs(ring.positions[ring.triangles].mean(axis=1)[:, :2]).max(axis=1) < 0.5
    holed = Mesh(ring.positions, ring.triangles[~middle])
    assert [len(polygon) for polygon in facets(holed)] == [3] * 16
    apart = Mesh(ring.positions, ring.triangles[np.abs(ring.positions[ring.triangles].mean(axis=1)[:, 0]) > 0.5])
    assert [len(polygon) for polygon in facets(apart)] == [4, 4]


@pytest.mark.parametrize(
    ("name", "closed"), [("box", True), ("sphere", True), ("torus", True), ("cone", True), ("disk", False)]
)
def test_solids_are_closed(name, closed):
    mesh = placed(getattr(shapes, name)(), somewhere())
    assert is_closed(mesh) == closed
    assert not is_closed(Mesh(mesh.positions, mesh.triangles[1:]))


def test_a_mesh_of_nothing_has_no_pieces_and_is_nothing():
    for triangles in (np.zeros((0, 3)), np.array([[0, 0, 1], [2, 2, 2]])):
        mesh = Mesh(np.eye(3), triangles)
        assert facets(mesh) == () and recognise(mesh) is None and not is_closed(Mesh(np.eye(3), np.zeros((0, 3))))


@pytest.mark.parametrize("cells", [1, 7])
def test_a_rectangle_is_recognised(cells):
    matrix = somewhere()
    found = recognise(placed(shapes.rectangle(2, 0.5, cells), matrix))
    assert isinstance(found, Rectangle)
    np.testing.assert_allclose(found.centre, matrix[:3, 3], atol=1e-6)
    np.testing.assert_allclose(sorted(found.extent), [0.25, 1.0], atol=1e-6)
    np.testing.assert_allclose(found.axes[2], matrix[:3, 2], atol=1e-5)
    np.testing.assert_allclose(found.axes @ found.axes.T, np.eye(3), atol=1e-5)
    long_side = found.axes[np.argmax(found.extent)]
    assert abs(long_side @ matrix[:3, 0]) == pytest.approx(1, abs=1e-6)


@pytest.mark.parametrize("rim", [12, 13, 64])
def test_a_disk_is_recognised_with_the_radius_of_its_area(rim):
    matrix = somewhere()
    found = recognise(placed(shapes.disk(0.4, rim), matrix))
    assert isinstance(found, Disk)
    np.testing.assert_allclose(found.centre, matrix[:3, 3], atol=1e-6)
    np.testing.assert_allclose(found.axes[2], matrix[:3, 1], atol=1e-5)
    np.testing.assert_allclose(np.cross(found.axes[0], found.axes[1]), found.axes[2], atol=1e-6)
    assert np.pi * found.radius**2 == pytest.approx(rim / 2 * 0.4**2 * np.sin(2 * np.pi / rim), rel=1e-5)


@pytest.mark.parametrize("segments", [16, 48])
def test_a_sphere_is_recognised_with_the_radius_of_its_area(segments):
    matrix = somewhere()
    world = placed(shapes.sphere(0.4, segments), matrix)
    found = recognise(world)
    assert isinstance(found, Sphere)
    np.testing.assert_allclose(found.centre, matrix[:3, 3], atol=1e-5)
    a, b, c = (world.positions[world.triangles[:, i]].astype(np.float64) for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
    assert 4 * np.pi * found.radius**2 == pytest.approx(area, rel=1e-6)


@pytest.mark.parametrize(
    "mesh",
    [
        shapes.box(1, 1, 1),
        shapes.torus(),
        shapes.cylinder(),
        shapes.disk(0.5, 8),
        sheet((0, 0), (1, 0), (1.5, 1), (0.5, 1)),
        sheet((0, 0), (2, 0), (1.5, 1), (0.5, 1)),
        sheet((0, 0), (1, 0), (0, 1)),
        Mesh(shapes.sphere(1, 16).positions, shapes.sphere(1, 16).triangles[:, ::-1]),
        Mesh(shapes.sphere(1, 16).positions, shapes.sphere(1, 16).triangles[:200]),
        Mesh(shapes.sphere(1, 16).positions * (1, 1, 1.01), shapes.sphere(1, 16).triangles),
    ],
    ids=["box", "torus", "cylinder", "octagon", "parallelogram", "trapezium", "triangle", "hollow", "open", "oval"],
)
def test_other_meshes_are_none_of_these(mesh):
    assert recognise(placed(mesh, somewhere())) is None
