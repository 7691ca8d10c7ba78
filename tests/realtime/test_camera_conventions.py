"""Where things land in the picture, against ray casting in float64 (conventions of `scenes.model`).

The bound on positions: a vertex is projected, divided and scaled to the window in float32 (about 8 roundings of its
coordinates), the attribute plane is set up from differences over the triangle and evaluated (about 8 more), and for
perspective two such planes are divided. Each rounding moves the result by ε of the largest coordinate in play: the
vertices' own, seen from the origin and from the camera. Hence |Δ| ≤ 24·ε·(largest |vertex| + largest distance).
"""

import numpy as np
import pytest

from lightmeter.scenes import shapes
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.model import Camera, Shape

from .ray_casting import cast, rays
from .small_scenes import WHITE, camera, card, facing, moved, points, scene_of

EPS = float(np.finfo(np.float32).eps)
CAMERAS = {
    "orthographic": camera(),
    "orthographic, aside": camera((2.0, 1.0, 2.0), ymag=0.8),
    "perspective": camera(yfov=0.8),
    "perspective, from +X": camera((3.0, 0.2, 0.0), yfov=0.7),
    "perspective, rolled": Camera("rolled", look_at((0.5, 2.0, 1.0), (0, 0, 0), (1, 0.3, 0)), yfov=1.0, near=0.1),
}
SIZE = (48, 32)


def bound(mesh, view: Camera) -> float:
    """The bound on positions that the module's text derives, metres."""
    reach = np.linalg.norm(mesh.positions, axis=1).max()
    return 24 * EPS * (reach + np.linalg.norm(mesh.positions - view.position, axis=1).max())


@pytest.mark.parametrize("size", [(8, 8), (16, 8), (6, 12)])
def test_pixels_are_sampled_at_their_centres_and_row_zero_is_the_top(device, size):
    seen = points(device, scene_of(facing(WHITE, 6, 6)), size)
    width, height = size
    for row in range(height):
        for column in range(width):
            x = (2 * (column + 0.5) / width - 1) * width / height
            y = 1 - 2 * (row + 0.5) / height
            assert np.abs(seen.position[row, column] - (x, y, 0)).max() < 4e-6


def test_a_triangle_in_the_top_left_corner_covers_the_pixels_whose_centres_it_holds(device):
    seen = points(device, scene_of(card([(-1, 1, 0), (-1, 0.313, 0), (-0.117, 1, 0)])), (20, 20))
    y, x = np.mgrid[0:20, 0:20]
    x, y = (x + 0.5) / 10 - 1, 1 - (y + 0.5) / 10
    expected = (y - 0.313) / 0.687 > (x + 1) / 0.883
    assert np.array_equal(seen.hit, expected)
    assert seen.hit[0, 0] and not seen.hit[0, -1] and not seen.hit[-1, 0]


@pytest.mark.parametrize("name", CAMERAS)
@pytest.mark.parametrize("offset", [(0.0, 0.0), (0.3, -0.45), (-0.5, 0.25)])
def test_planes_and_spheres_are_where_rays_meet_them(device, name, offset):
    """Positions, normals and the triangle's number, for every pixel that does not graze an edge."""
    view = CAMERAS[name]
    ball = shapes.sphere(0.6, segments=20)
    for mesh in (shapes.box(0.9, 1.1, 0.7, segments=2), ball):
        seen = points(device, scene_of(Shape("it", mesh, WHITE), view=view), SIZE, offset)
        position, triangle, weights, margin = cast(mesh, *rays(view, SIZE, offset))
        sure = margin > 1e-2
        assert sure.mean() > 0.75
        assert np.array_equal(seen.triangle[sure], triangle[sure])
        hit = sure & (triangle >= 0)
        assert hit.sum() > 100
        assert np.abs(seen.position[hit] - position[hit]).max() <= bound(mesh, view)
        corners = mesh.normals[mesh.triangles[triangle[hit]]].astype(np.float64)
        normal = np.einsum("nk,nkc->nc", weights[hit], corners)
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        # A normal turns with the point's place in its triangle: over the shortest edge it may turn fully.
        edge = np.linalg.norm(np.diff(mesh.positions[mesh.triangles], axis=1), axis=2).min()
        assert np.abs(seen.normal[hit] - normal).max() <= bound(mesh, view) / edge + 8 * EPS
        towards = (
            view.position - position[hit]
            if view.yfov is not None
            else np.broadcast_to(view.matrix[:3, 2], normal.shape)
        )
        towards = towards / np.linalg.norm(towards, axis=1, keepdims=True)
        assert np.abs(seen.view[hit] - towards).max() <= bound(mesh, view) / 0.5 + 8 * EPS


@pytest.mark.parametrize("name", CAMERAS)
def test_a_positive_offset_samples_further_right_and_down(device, name):
    view = CAMERAS[name]
    across = Shape("wall", shapes.rectangle(40, 40), WHITE, view.matrix @ moved(z=-2.0))
    here = points(device, scene_of(across, view=view), SIZE).position @ view.matrix[:3, :3]
    there = points(device, scene_of(across, view=view), SIZE, (0.5, 0.5)).position @ view.matrix[:3, :3]
    assert (there[..., 0] > here[..., 0]).all()
    assert (there[..., 1] < here[..., 1]).all()
    half = points(device, scene_of(across, view=view), (SIZE[0] * 2, SIZE[1] * 2)).position @ view.matrix[:3, :3]
    quarter = points(device, scene_of(across, view=view), SIZE, (0.25, 0.25)).position @ view.matrix[:3, :3]
    assert np.abs(quarter - half[1::2, 1::2]).max() < 1e-4


def test_every_triangle_of_a_large_mesh_has_its_own_number(device):
    """Beyond 4096 triangles, where the number no longer fits the first 12 bits; and beyond 2·4096 with shapes mixed."""
    mesh = shapes.rectangle(2, 2, segments=80)
    size = (160, 160)
    left, right = np.eye(4), np.eye(4)
    left[:2, :2] = right[:2, :2] = np.diag([0.5, 1.0])
    left[0, 3], right[0, 3] = -0.5, 0.5
    scene = scene_of(Shape("a", mesh, WHITE, left), Shape("b", mesh, WHITE, right))
    seen = points(device, scene, size, (0.1, 0.2))
    column, row = (np.arange(160) + 0.6) / 160, (np.arange(160) + 0.7) / 160
    u, v = np.meshgrid(column * 2 % 1, row)
    cell = np.floor(v * 80) * 80 + np.floor(u * 80)
    upper = (u * 80 % 1) > (v * 80 % 1)
    expected = cell + np.where(upper, 6400, 0)
    assert np.array_equal(seen.shape, np.broadcast_to(np.where(column < 0.5, 0, 1), (160, 160)))
    sure = np.abs((u * 80 % 1) - (v * 80 % 1)) > 0.02
    assert sure.all()
    assert np.array_equal(seen.triangle, expected.astype(np.int32))
    assert seen.triangle.max() > 8192


def test_nothing_is_minus_one(device):
    seen = points(device, scene_of(card([(-0.2, -0.2, 0), (0.2, -0.2, 0), (0, 0.2, 0)])), (16, 16))
    assert (seen.shape[~seen.hit] == -1).all() and (seen.triangle[~seen.hit] == -1).all()
    assert 0 < seen.hit.sum() < 256
