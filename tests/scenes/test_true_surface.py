"""Forms: how far triangles are from the shapes that they stand for, against closed forms."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.groundtruth.content import scene_key
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Mesh
from lightmeter.scenes.shapes.forms import Cylinder, Sphere, Torus
from lightmeter.scenes.true_surface import FINE, MOST_FORMS, tessellated, true_surface

FORMS = (Sphere(0.7), Torus(0.9, 0.35), Cylinder(0.4, 1.5), Cylinder(0.4, 1.5, caps=False))


def corners(mesh: Mesh) -> np.ndarray:
    """(M, 3, 3) float64."""
    return mesh.positions[mesh.triangles].astype(np.float64)


PARTS = 12
"""Into how many parts the sides of triangles are divided for samples."""


def sampled(mesh: Mesh) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The middles of PARTS² equal parts of every triangle, the faces' normals there, the area that each stands for.

    A mean square over them lacks what varies inside the parts, 1/PARTS² of the whole.
    """
    i, j = (grid.ravel() for grid in np.mgrid[:PARTS, :PARTS])
    upright, inverted = i + j < PARTS, i + j < PARTS - 1
    u, v = (np.concatenate([k[upright] + 1 / 3, k[inverted] + 2 / 3]) / PARTS for k in (i, j))
    triangles = corners(mesh)
    p, e, f = triangles[:, 0], triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    cross = np.cross(e, f)
    area = np.linalg.norm(cross, axis=1)
    points = p[:, None] + u[:, None] * e[:, None] + v[:, None] * f[:, None]
    normals = np.broadcast_to((cross / area[:, None])[:, None], points.shape)
    return points.reshape(-1, 3), normals.reshape(-1, 3), np.repeat(area, len(u))


def angles(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Between unit vectors; by the sine, which keeps its digits where they are small."""
    return np.arctan2(np.linalg.norm(np.cross(one, other), axis=-1), np.sum(one * other, axis=-1))


@pytest.mark.parametrize("form", FORMS, ids=str)
def test_vertices_and_normals_are_true(form):
    """To float32's rounding, 6·10⁻⁸ of coordinates of about 1. On a rim two normals are as near."""
    mesh = form.mesh(24)
    nearest, normals = form.nearest(mesh.positions.astype(np.float64))
    np.testing.assert_allclose(mesh.positions, nearest, atol=3e-7)
    if not (isinstance(form, Cylinder) and form.caps):
        np.testing.assert_allclose(mesh.normals, normals, atol=1e-6)


def test_a_sphere_of_facets_has_normals_wrong_by_what_geometry_says():
    """A facet's plane cuts the sphere in a circle, and its normal goes through the circle's centre.

    Next to a pole-to-pole angle θ a facet is a right triangle of legs Δ and Δ·sin θ, Δ = 2π/N, with the centre in the
    middle of its hypotenuse: the farthest point is at half of it, √2·Δ/2 = √2·π/N at the equator, and the mean square
    of the distance is Δ²(1 + sin² θ)/12. Over the sphere sin² θ is 2/3 on average: 5Δ²/36. Higher orders are of
    relative size Δ².
    """
    for steps in (32, 64):
        points, faces, areas = sampled(Sphere(1.0).mesh(steps))
        wrong, delta = angles(Sphere(1.0).nearest(points)[1], faces), 2 * np.pi / steps
        rms = np.sqrt(np.average(wrong**2, weights=areas))
        assert rms == pytest.approx(delta * np.sqrt(5) / 6, rel=delta**2 + PARTS**-2)
        assert wrong.max() == pytest.approx(np.sqrt(2) * np.pi / steps, rel=0.1)  # no sample is at a corner itself


def test_a_cylinders_facets_are_wrong_by_half_their_angle_at_most():
    """Evenly from 0 in a facet's middle to π/N at its edges: the root mean square is π/(N·√3)."""
    steps, form = 24, Cylinder(1.0, 2.0, caps=False)
    points, faces, areas = sampled(form.mesh(steps))
    wrong = angles(form.nearest(points)[1], faces)
    assert wrong.max() < np.pi / steps
    rms = np.sqrt(np.average(wrong**2, weights=areas))
    assert rms == pytest.approx(np.pi / steps / np.sqrt(3), rel=(np.pi / steps) ** 2 + PARTS**-2)


@pytest.mark.parametrize("steps", [8, 12, 48])
def test_the_silhouettes_area_is_the_polygons(steps):
    """Seen along its axis a sphere is a regular N-gon: 1 − sin(2π/N)/(2π/N) of the disk's area is lacking."""
    shadow = corners(Sphere(1.0).mesh(steps))[..., [2, 0]]
    one, other = shadow[:, 1] - shadow[:, 0], shadow[:, 2] - shadow[:, 0]
    area = np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]).sum() / 4  # both halves of the sphere
    angle = 2 * np.pi / steps
    assert 1 - area / np.pi == pytest.approx(1 - np.sin(angle) / angle, abs=1e-6)


def test_the_fine_tessellation_is_as_near_as_it_says():
    bounds = {Sphere(1.0): 1 - np.cos(np.sqrt(2) * np.pi / FINE), Cylinder(1.0, 2.0, False): 1 - np.cos(np.pi / FINE)}
    for form, bound in bounds.items():
        centres = corners(form.mesh(FINE)).mean(axis=1)
        off = np.linalg.norm(form.nearest(centres)[0] - centres, axis=1)
        assert 0.3 * bound < off.max() < bound + 3e-7


def test_only_what_has_a_form_gets_another_surface():
    scene = load("tessellation")
    coarse, true = tessellated(scene, 8, smooth=False), true_surface(scene)
    assert [s.mesh is o.mesh for s, o in zip(coarse.shapes, scene.shapes, strict=True)] == [True, False, False, False]
    assert all(s.mesh.normals is None for s in coarse.shapes[1:])
    assert true_surface(true) is true and true_surface(scene) is true
    assert len(true.shapes[1].mesh.triangles) == 2 * FINE * (FINE // 2 - 1)
    flat = load("cornell-box")
    assert true_surface(flat) is flat


def test_many_forms_share_the_triangles():
    scene = load("control")
    crowd = replace(scene, shapes=scene.shapes * (MOST_FORMS + 1))
    assert len(true_surface(crowd).shapes[0].mesh.triangles) == 2 * (FINE // 2) * (FINE // 4 - 1)


def test_a_form_alone_changes_no_light():
    """References of scenes that are drawn with their own triangles are found again whether they have forms or not."""
    scene = load("control")
    bare = replace(scene, shapes=tuple(replace(shape, form=None) for shape in scene.shapes))
    assert scene_key(bare) == scene_key(scene)
