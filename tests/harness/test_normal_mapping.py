"""Normal mapping: the real-time side's shading normal, the truth's at the same points, and both against float64.

All three interpolate tangent and normal over the triangle without renormalising, make the bitangent at the point and
normalise last. The map is one texel of floats, so that filtering has no part in it.

Tolerance, with ε = 2⁻²⁴. The frame's sum of three vectors and its normalisation take ten roundings of terms that are
not above |v|, the length before normalising, but for cancellation: 10·ε·Σ|terms|/|v|. What was interpolated has the
error of the coordinates in the triangle times D, the largest difference between two corners' normals and tangents. The
truth finds them in double precision from a position rounded to float32: ε·|position| over the triangle's least height.
A rasteriser evaluates planes a₀ + x·∂a/∂x + y·∂a/∂y in float32 over an image of w pixels: with e the triangle's
longest edge and h its least height in pixels, the slope is D/h and its determinant cancels by e/h, so that
ε·D·(w/h + (e/h)²) remains, times some 4 roundings.
"""

import numpy as np
import pytest

from lightmeter.groundtruth.oracles import material
from lightmeter.groundtruth.world import World
from lightmeter.realtime.device import Device
from lightmeter.scenes import shapes
from lightmeter.scenes.model import Image, Material, Mesh, Scene, Shape, Texture
from lightmeter.scenes.optics import frames
from lightmeter.scenes.tangents import with_tangents
from tests.realtime.small_scenes import camera, renderer

TEXEL = np.float32([[[0.85, 0.3, 0.8]]])
SCALE = 0.7
SIZE = (48, 48)

MATRICES = {
    "as it is": np.eye(3),
    "mirrored": np.diag([-1.0, 1.0, 1.0]),
    "turned over": np.diag([1.0, -1.0, -1.0]),
    "stretched": np.diag([1.3, 0.5, 0.8]),
    "sheared and mirrored": np.array([[0.9, 0.4, 0.1], [-0.2, -0.8, 0.3], [0.0, 0.2, 1.1]]),
}


def mirrored_ring() -> Mesh:
    """A torus whose image runs forth and back about it."""
    mesh = shapes.torus(0.7, 0.25, 24, 12)
    uv = mesh.texcoords[0] * np.float32([2, 1])
    uv[:, 0] = 1 - np.abs(uv[:, 0] - 1)
    return with_tangents(Mesh(mesh.positions, mesh.triangles, mesh.normals, (uv,)))


def bowl() -> Mesh:
    """A coarse sphere's lower half: through its rim the inside is seen."""
    mesh = shapes.sphere(0.9, 16, 10)
    centres = mesh.positions[mesh.triangles].mean(axis=1)
    lower = mesh.triangles[centres[:, 2] < 0]
    return with_tangents(Mesh(mesh.positions, lower, mesh.normals, mesh.texcoords))


def bumpy(mesh: Mesh, matrix: np.ndarray) -> Scene:
    """The mesh with the one texel's normal, seen a little from the side."""
    texture = Texture(Image(TEXEL, "lean"), mag_filter="nearest", min_filter="nearest")
    made = Material("bumpy", normal_texture=texture, normal_scale=SCALE, double_sided=True)
    placed = np.eye(4)
    placed[:3, :3] = matrix
    return Scene("bumpy", (Shape("shape", mesh, made, placed),), camera((0.3, 1.8, 2.6), ymag=1.2))


def expected_normals(scene: Scene, points) -> tuple[np.ndarray, np.ndarray]:
    """(n, 3) float64 from positions and the mesh in world space, and (n, 2) what the two sides may be off."""
    mesh = scene.shapes[0].world
    rows = mesh.triangles[points.triangle]
    corners = mesh.positions[rows].astype(np.float64)
    edges = corners[:, 1:] - corners[:, :1]
    weights = np.einsum("nij,nj->ni", np.linalg.pinv(edges.swapaxes(1, 2)), points.position - corners[:, 0])
    weights = np.c_[1 - weights.sum(axis=1), weights]
    frames_at = np.concatenate([mesh.normals[rows], mesh.tangents[rows]], axis=2).astype(np.float64)
    normal, tangent = np.split(np.einsum("nk,nkc->cn", weights, frames_at), [3])
    texel = np.broadcast_to(TEXEL.reshape(3, 1).astype(np.float64), normal.shape)
    mapped = frames.decode_normal(texel, SCALE, lambda *parts: np.stack(parts))
    found = frames.tangent_to_world(tangent[:3], np.sign(tangent[3]), normal, mapped).T
    behind = np.sum(np.cross(edges[:, 0], edges[:, 1]) * points.view, axis=1) < 0

    eps, width = 2.0**-24, SIZE[0]
    spread = np.linalg.norm(frames_at - np.roll(frames_at, 1, axis=1), axis=2).max(axis=1)
    lengths = np.linalg.norm(mapped, axis=0)
    in_pixels = corners @ scene.camera.matrix[:3, :2] * (SIZE[1] / 2 / scene.camera.ymag)
    edge, height = longest_and_least(in_pixels)
    size = np.linalg.norm(points.position, axis=1) / longest_and_least(corners)[1]
    cancelling = np.sum(np.abs(mapped), axis=0) / (lengths * 0.8)  # interpolated normals are no shorter than 0.8
    sides = np.stack([spread * (width / height + (edge / height) ** 2) * 4, spread * size], axis=1)
    return np.where(behind[:, None], -found, found), eps * cancelling[:, None] * (10 + sides)


def longest_and_least(corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Of triangles (n, 3, d): the longest edge and the least height."""
    edge = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    first, second = (corners[:, k] - corners[:, 0] for k in (1, 2))
    gram = np.sum(first**2, axis=1) * np.sum(second**2, axis=1) - np.sum(first * second, axis=1) ** 2
    return edge, np.sqrt(np.maximum(gram, 0)) / edge


@pytest.mark.parametrize("mesh", [mirrored_ring(), bowl()], ids=["mirrored ring", "bowl from both sides"])
@pytest.mark.parametrize("matrix", MATRICES.values(), ids=MATRICES)
def test_both_sides_see_the_same_mapped_normal(mesh, matrix):
    scene = bumpy(mesh, matrix)
    seen = renderer(Device(), scene, SIZE).capture((0.1, -0.2), terms=False).points
    truth = material.evaluate(World.of(scene), seen)
    points = seen.at(seen.hit)
    expected, allowed = expected_normals(scene, points)
    assert len(expected) > 400 and np.median(allowed) < 1e-4
    sides = np.stack([points.normal, truth.normal[seen.hit]], axis=1)
    errors = np.linalg.norm(sides - expected[:, None], axis=2)
    assert (errors <= allowed).all(), f"errs by {(errors / allowed).max(axis=0)} of what rounding explains"
