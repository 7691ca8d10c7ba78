"""The procedural shapes: closed, facing outwards, and converging to the closed forms of area and volume."""

from math import pi, sqrt

import numpy as np
import pytest

from lightmeter.scenes import shapes
from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.model import Mesh

ALL = ("box", "cone", "cylinder", "disk", "plane", "rectangle", "sphere", "torus")
CLOSED = ("box", "cone", "cylinder", "sphere", "torus")


def corners(mesh: Mesh) -> np.ndarray:
    """(M, 3, 3) float64: each triangle's corners."""
    return mesh.positions.astype(np.float64)[mesh.triangles]


def area_vectors(mesh: Mesh) -> np.ndarray:
    a, b, c = np.moveaxis(corners(mesh), 1, 0)
    return np.cross(b - a, c - a) / 2


def area(mesh: Mesh) -> float:
    return float(np.linalg.norm(area_vectors(mesh), axis=1).sum())


def volume(mesh: Mesh) -> float:
    a, b, c = np.moveaxis(corners(mesh), 1, 0)
    return float(np.sum(a * np.cross(b, c)) / 6)


@pytest.mark.parametrize("name", CLOSED)
def test_every_edge_has_its_opposite(name):
    mesh = getattr(shapes, name)()
    _, same = np.unique(mesh.positions, axis=0, return_inverse=True)
    triangles = same.reshape(-1)[mesh.triangles]
    edges = {(int(t[i]), int(t[(i + 1) % 3])) for t in triangles for i in range(3)}
    assert len(edges) == 3 * len(triangles)
    assert all((b, a) in edges for a, b in edges)


@pytest.mark.parametrize("name", ALL)
def test_no_triangle_is_degenerate_and_normals_agree_with_the_front(name):
    mesh = getattr(shapes, name)()
    faces = area_vectors(mesh)
    areas = np.linalg.norm(faces, axis=1)
    assert areas.min() > 1e-5
    np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-6)
    cosines = np.einsum("mi,mki->mk", faces / areas[:, None], mesh.normals[mesh.triangles])
    assert cosines.min() > 0.99


@pytest.mark.parametrize("name", ALL)
def test_images_are_not_mirrored(name):
    mesh = getattr(shapes, name)()
    uv = mesh.texcoords[0].astype(np.float64)[mesh.triangles]
    right, down = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
    assert (right[:, 0] * down[:, 1] - right[:, 1] * down[:, 0]).max() < 0  # v points down


@pytest.mark.parametrize(
    ("make", "true_area", "true_volume"),
    [
        (lambda n: shapes.sphere(0.5, n), pi, pi / 6),
        (lambda n: shapes.torus(1.0, 0.25, n, n // 2), pi**2, pi**2 / 8),
        (lambda n: shapes.cylinder(0.5, 2.0, n), 2.5 * pi, pi / 2),
        (lambda n: shapes.cone(1.0, 1.0, n), pi * (1 + sqrt(2)), pi / 3),
    ],
    ids=["sphere", "torus", "cylinder", "cone"],
)
def test_area_and_volume_converge_with_the_square_of_the_step(make, true_area, true_volume):
    coarse, fine = make(32), make(128)
    for measured, true in ((area, true_area), (volume, true_volume)):
        first, second = true - measured(coarse), true - measured(fine)
        assert 0 < second < 0.004 * true
        assert first / second == pytest.approx(16, rel=0.1)


def test_box_and_sheets_are_exact():
    assert area(shapes.box(1, 2, 3, 2)) == pytest.approx(22)
    assert volume(shapes.box(1, 2, 3, 2)) == pytest.approx(6)
    assert area(shapes.plane(2, 3, 4)) == pytest.approx(6)
    assert area(shapes.rectangle(2, 3)) == pytest.approx(6)
    assert area(shapes.disk(1, 512)) == pytest.approx(pi, rel=1e-4)


@pytest.mark.parametrize("name", ["sphere", "disk", "rectangle", "plane"])
def test_an_image_stands_upright(name):
    """On what faces +Z, u follows +X and v −Y; on what lies, v follows +Z."""
    mesh = getattr(shapes, name)(segments=64)
    facing = (mesh.positions[:, 2] > 0.99) if name == "sphere" else np.ones(len(mesh.positions), bool)
    u, v = mesh.texcoords[0][facing].T
    x, y, z = mesh.positions[facing].T
    assert np.corrcoef(u, x)[0, 1] > 0.95
    assert np.corrcoef(v, z if name in ("disk", "plane") else -y)[0, 1] > 0.95


@pytest.mark.parametrize(
    "call",
    [
        lambda: shapes.sphere(-1),
        lambda: shapes.sphere(float("nan")),
        lambda: shapes.sphere(1, 2),
        lambda: shapes.sphere(1, 10**9),
        lambda: shapes.sphere(1, 8.5),
        lambda: shapes.torus(1, 1),
        lambda: shapes.box(True),
        lambda: shapes.plane(1e30),
        lambda: shapes.cone(segments=0),
    ],
)
def test_parameters_out_of_range_are_refused(call):
    with pytest.raises(SceneError, match="expected"):
        call()


def test_the_least_tessellation_works():
    for mesh in (shapes.sphere(1, 3, 2), shapes.torus(1, 0.4, 3, 3), shapes.cone(1, 1, 3, 1), shapes.disk(1, 3)):
        assert np.linalg.norm(area_vectors(mesh), axis=1).min() > 0
