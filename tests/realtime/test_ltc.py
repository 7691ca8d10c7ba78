"""Linearly transformed cosines: the table against quadrature, the shader against Lambert's formula and the light."""

import math
from pathlib import Path

import numpy as np
import pytest

from lightmeter.realtime.effects.ltc_area_light import fit
from lightmeter.realtime.effects.ltc_area_light.outline import outline
from lightmeter.realtime.effects.ltc_area_light.table import fitted
from lightmeter.scenes import shapes
from lightmeter.scenes.model import Material, Mesh, Shape
from lightmeter.scenes.optics import material

from .area_quadrature import of_polygon, reflected
from .area_scenes import GLOW, RADIANCE, direct_of, lit_floor, turned
from .small_scenes import camera, moved

EPS = float(np.finfo(np.float32).eps)
TORUS = shapes.torus(0.3, 0.1, 24, 12)
DIFFUSE = Material("diffuse", (0.8, 0.6, 0.4), specular=0.0)
OVER = turned((0, 0, 0), (0.3, 1.4, -0.5))
LOW = turned((0.0, 0.3, 0.0), (0.3, 0.4, -1.2))
L = Mesh(
    0.5 * np.array([(0, 0, 0), (2, 0, 0), (2, 1, 0), (1, 1, 0), (1, 2, 0), (0, 2, 0)], np.float32),
    np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]),
)
DOWNWARDS = np.eye(4)
DOWNWARDS[:2, :2] = np.sqrt(0.5) * np.array([[-1, 1], [-1, -1]])
LIGHTS = {
    "above": (shapes.rectangle(0.8, 0.5), OVER),
    "cut by the horizon": (shapes.rectangle(1.5, 1.5), LOW),
    "far away": (shapes.rectangle(0.02, 0.01), turned((0, 0, 0), (3, 9, -5))),
    "a box": (shapes.box(0.4, 0.3, 0.2), LOW),
    "an L, both arms cut": (L, turned((0, 0.75, 0), (0.1, 0.75, -1.2)) @ DOWNWARDS),
}


def interpolated(row: float, column: float) -> np.ndarray:
    """The table between its entries, bilinearly."""
    table = fitted()
    r, c = min(int(row), len(table) - 2), min(int(column), len(table) - 2)
    low, high = (table[i, c] + (column - c) * (table[i, c + 1] - table[i, c]) for i in (r, r + 1))
    return low + (row - r) * (high - low)


def lobe_and_fit(roughness: float, cosine: float, samples: int = 48):
    """The lobe, and the cosine and the two albedos that the table has for it."""
    side = len(fitted()) - 1
    lobe = fit.Lobe.of(max(roughness**2, 1e-3), cosine, samples, fine=64)
    numbers = interpolated(roughness * side, math.sqrt(1 - lobe.view[2]) * side)
    cosine_found = fit.Cosine.of(lobe, numbers)
    return lobe, cosine_found, numbers[4:] * cosine_found.above


def hemisphere(steps: int):
    """Directions (3, n) and solid angles, by Gauss-Legendre in the cosine."""
    nodes, weights = np.polynomial.legendre.leggauss(steps)
    z, turn = (nodes + 1) / 2, (np.arange(2 * steps) + 0.5) * np.pi / steps
    z, turn = np.meshgrid(z, turn, indexing="ij")
    s = np.sqrt(1 - z**2)
    solid = np.repeat(weights / 2, 2 * steps) * np.pi / steps
    return np.stack([s * np.cos(turn), s * np.sin(turn), z]).reshape(3, -1), solid


@pytest.mark.parametrize("roughness", [0.3, 0.5, 1.0])
@pytest.mark.parametrize("cosine", [1.0, 0.6, 0.2])
def test_the_fit_s_error_and_its_albedos_are_what_quadrature_finds(roughness, cosine):
    """Over a grid of directions and with the shared optics, which the fit's own samples do not use.

    The fit's means over 48² points are good to a few hundredths of the variation: their integrand has a kink where
    f/E = D.
    """
    lobe, found, (albedo, grazing) = lobe_and_fit(roughness, cosine)
    directions, solid = hemisphere(125)
    mirror = material.MaterialPoint(np.ones((3, 1)), np.ones(1), np.full(1, roughness), np.ones(1))
    up = np.array([[0.0], [0.0], [1.0]])
    value = material.evaluate(mirror, up, lobe.view[:, None], directions)[0]
    h = directions + lobe.view[:, None]
    v_dot_h = lobe.view @ (h / np.linalg.norm(h, axis=0))
    assert np.sum(value * solid) == pytest.approx(albedo, rel=4e-3)
    assert np.sum(value * (1 - v_dot_h) ** 5 * solid) == pytest.approx(grazing, rel=2e-2, abs=2e-5)
    density = found.density(directions)
    assert np.sum(density * solid) == pytest.approx(1, abs=2e-3)
    exact = np.sum(np.abs(value / np.sum(value * solid) - density) * solid) / 2
    assert fit.variation(lobe, found, 48) == pytest.approx(exact, rel=0.05, abs=2e-4)


def test_the_fit_s_error_is_what_the_docs_say():
    """Per cent, to the last digit or a hundredth: there are fewer samples here."""
    text = (Path(__file__).parents[2] / "docs" / "lights.md").read_text(encoding="utf-8").split("<!-- fit -->")[1]
    head, _, *rows = ([cell.strip() for cell in line.strip("| ").split("|")] for line in text.strip().splitlines())
    angles = [float(cell.rstrip("°")) for cell in head[1:]]
    assert len(rows) == 6 and len(angles) == 5
    for roughness, *cells in (map(float, row) for row in rows):
        for angle, stated in zip(angles, cells, strict=True):
            lobe, found, _ = lobe_and_fit(roughness, math.cos(math.radians(angle)), 64)
            assert 100 * fit.variation(lobe, found, 64) == pytest.approx(stated, rel=0.01, abs=0.06)


def test_white_rough_metal_has_its_albedo():
    """Design, section 8: α = 1 straight from above, 1 − ln 2."""
    assert lobe_and_fit(1.0, 1.0)[2][0] == pytest.approx(1 - math.log(2), abs=1e-3)


@pytest.mark.parametrize(("row", "column"), [(31, 0), (16, 16), (9, 24)])
def test_the_table_is_what_the_script_finds(row, column):
    """Searched for again from the table's neighbour, the variation gets no smaller."""
    lobe = fit.Lobe.of(fit.roughness_of(row) ** 2, fit.cosine_of(column), 24)
    there = fit.variation(lobe, fit.Cosine.of(lobe, fitted()[row, column]), 24)
    found = fit.fit(lobe, [fitted()[row - 1, column, :4]])
    assert there <= 1.03 * fit.variation(lobe, fit.Cosine.of(lobe, found), 24) + 1e-3


def world_facets(mesh, matrix) -> list[np.ndarray]:
    world = Shape("light", mesh, GLOW, matrix).world
    return list(world.positions[world.triangles].astype(np.float64))


def lambert(point, normal, corners):
    """Irradiance of a polygon of radiance 1 (Lambert 1760) cut at the horizon, and the sum of its sides' magnitudes."""
    heights = (corners - point) @ normal
    kept = []
    for i in range(len(corners)):
        j = (i + 1) % len(corners)
        if heights[i] > 0:
            kept.append(corners[i])
        if heights[i] * heights[j] < 0:
            kept.append(corners[i] + (corners[j] - corners[i]) * heights[i] / (heights[i] - heights[j]))
    total = magnitude = 0.0
    for i in range(len(kept)):
        a, b = kept[i] - point, kept[(i + 1) % len(kept)] - point
        across = np.cross(b, a)
        length = np.linalg.norm(across)
        angle = math.atan2(length, float(a @ b))
        total += angle * float(across @ normal) / max(length, 1e-300) / 2
        magnitude += angle / 2
    return max(total, 0.0), magnitude


@pytest.mark.parametrize("name", LIGHTS)
def test_the_base_is_lit_by_lambert_s_formula(device, name):
    """To rounding. A side carries 29 of them (`twin.py`), its turn into the surface's frame and the corners' own
    subtraction ten more; they count in the sides' magnitudes, of which little is left for a light far away.
    """
    mesh, matrix = LIGHTS[name]
    points, got = direct_of(device, lit_floor(DIFFUSE, mesh, matrix), "ltc_area_light", size=(12, 8))
    polygons = world_facets(mesh, matrix)
    for place, normal, value in zip(points.position, points.normal, got, strict=True):
        parts = [lambert(place.astype(float), normal.astype(float), corners) for corners in polygons]
        scale = np.array(DIFFUSE.base_color) * np.array(RADIANCE) / np.pi
        exact, magnitude = (np.sum(part) for part in zip(*parts, strict=True))
        assert (np.abs(value - exact * scale) <= 40 * EPS * (magnitude + exact) * scale + 1e-12).all()
    assert got.max() > 0


@pytest.mark.parametrize("roughness", [0.25, 1.0])
@pytest.mark.parametrize("height", [0.6, 2.5])
def test_the_lobe_s_error_is_within_the_fit_s_bound(device, roughness, height):
    """Two densities differ over no region by more than their total variation; times albedo and radiance.

    Besides, a filter's weights have 8 bits (2⁻⁹), which moves the entries by as much of their step from one row or
    column to the next, and quadrature is good to 1e-3 here.
    """
    white = Material("white metal", (1.0, 1.0, 1.0), metallic=1.0, roughness=roughness)
    mesh, matrix = shapes.rectangle(0.8, 0.5), turned((0, 0, 0), (0.2, 0.7, -0.9))
    view = camera((0.0, height, 2.0), (0.0, 0.0, 0.0), yfov=0.7)
    points, got = direct_of(device, lit_floor(white, mesh, matrix, view=view), "ltc_area_light", size=(7, 4))
    places, areas = of_polygon(outline_corners(mesh, matrix), 64)
    exact = reflected(points, places, areas, RADIANCE)
    cosines = np.sum(points.normal * points.view, axis=1)
    worst = 0.0
    for value, truth, cosine in zip(got, exact, cosines, strict=True):
        lobe, found, (albedo, _) = lobe_and_fit(roughness, float(cosine), 24)
        allowed = (fit.variation(lobe, found, 24) + 0.002) * albedo
        worst = max(worst, np.max(np.abs(value - truth) / np.array(RADIANCE)) / allowed)
    assert worst <= 1
    assert exact.max() > 0.1 and np.sqrt(np.mean((got - exact) ** 2)) < 0.1 * np.sqrt(np.mean(exact**2))


@pytest.mark.parametrize("roughness", [0.2, 0.6])
def test_a_polygon_lights_as_its_parts_together(device, roughness):
    """In the lobe, where both horizons cut it: a rectangle, and the two triangles of it; to the sides' rounding."""
    metal = Material("metal", (1.0, 0.8, 0.6), metallic=1.0, roughness=roughness)
    mesh, matrix = LIGHTS["cut by the horizon"]
    parts = [Mesh(mesh.positions, mesh.triangles[:1]), Mesh(mesh.positions, mesh.triangles[1:])]
    beside = camera((0.0, 1.0, 2.5), (0.0, 0.0, 0.8), yfov=0.5)  # sees none of the light
    made = [direct_of(device, lit_floor(metal, part, matrix, view=beside), "ltc_area_light") for part in (mesh, *parts)]
    whole, first, second = (value for _, value in made)
    np.testing.assert_allclose(whole, first + second, rtol=1e-4, atol=1e-5)
    assert (first > 1e-3).any() and (second > 1e-3).any()


def outline_corners(mesh, matrix) -> np.ndarray:
    """A rectangle's corners in world space, in order."""
    scene = lit_floor(DIFFUSE, mesh, matrix)
    found = outline(scene, scene.area_lights[0], 48, 16)
    return found.centre + found.corners[:, :3]


def test_a_sphere_lights_as_the_cone_around_it(device):
    """Wholly above the horizon: E = π·(R/d)²·cos θ, to the mesh's own area and an outline of 64 corners: 1e-3."""
    points, got = direct_of(
        device, lit_floor(DIFFUSE, shapes.sphere(0.3, 64), moved(0.2, 1.0, -0.3)), "ltc_area_light", rim=64
    )
    offset = np.array([0.2, 1.0, -0.3]) - points.position
    square = np.sum(offset**2, axis=1)
    radius_square = outline_of(shapes.sphere(0.3, 64)).sphere_radius ** 2
    irradiance = radius_square / square * np.sum(offset * points.normal, axis=1) / np.sqrt(square)
    exact = irradiance[:, None] * np.array(DIFFUSE.base_color) * np.array(RADIANCE)
    np.testing.assert_allclose(got, exact, rtol=1e-3)


def outline_of(mesh, most=48, rim=16, glow=GLOW):
    scene = lit_floor(DIFFUSE, mesh, np.eye(4), glow)
    return outline(scene, scene.area_lights[0], most, rim)


def test_what_stands_for_a_shape():
    """Polygons as they are, rims with as many corners as asked for, and a sphere of its surface for a finer mesh."""
    assert len(outline_of(shapes.rectangle(1, 2, 5)).corners) == 4
    assert len(outline_of(L).corners) == 12  # not convex: its triangles
    box = outline_of(shapes.box(1, 1, 1, 4))
    assert len(box.corners) == 24 and box.corners[:, 3].sum() == 6 and box.sphere_radius == 0
    disk = outline_of(shapes.disk(0.5, 64), rim=8)
    a, b = disk.corners[:, :3], np.roll(disk.corners[:, :3], -1, axis=0)
    area = np.linalg.norm(np.cross(a, b).sum(axis=0)) / 2
    assert len(disk.corners) == 8 and area == pytest.approx(32 * 0.25 * math.sin(2 * math.pi / 64), rel=1e-6)
    assert len(outline_of(shapes.disk(0.5, 12), rim=16).corners) == 12  # its own rim is the coarser one
    torus = outline_of(TORUS)  # whose area falls short of 4π²·R·r by some hundredths
    assert torus.sphere_radius == pytest.approx(math.sqrt(4 * math.pi**2 * 0.03 / (4 * math.pi)), rel=0.03)
    both = Material("both", emissive=(1, 1, 1), double_sided=True)
    assert outline_of(TORUS, glow=both).sphere_radius == torus.sphere_radius  # a solid's inside is not seen
    bowl = Mesh(TORUS.positions, TORUS.triangles[: len(TORUS.triangles) // 2])
    assert outline_of(bowl, glow=both).sphere_radius == pytest.approx(math.sqrt(2) * outline_of(bowl).sphere_radius)
    assert outline_of(shapes.box(1, 1, 1), most=23).sphere_radius == pytest.approx(math.sqrt(6 / (4 * math.pi)))
