"""Gouraud shading: what is computed at vertices, against the same in double precision, and how its error falls."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Camera, Texture

from .direct_definition import exact_direct
from .small_scenes import image

SIZE = (96, 96)


def torus():
    """A torus alone, under its point light."""
    scene = load("torus")
    camera = Camera("camera", look_at((0.3, 3.0, 1.2), (0, 0.35, 0)), yfov=0.85)
    return replace(scene, shapes=scene.shapes[1:], camera=camera)


def captured(device, scene, steps: int, model: str = "cook_torrance", offset=(0.0, 0.0)):
    choice = Choice(use=("gouraud",), settings={"gouraud": {"tessellation": steps, "model": model}})
    there = Renderer(device, compile_plan(scene, effects(), choice), SIZE)
    there.capture((-0.4, 0.45))  # what was drawn for another sample is not taken for this one
    return there.capture(offset)


def test_light_at_vertices_is_interpolated_over_the_triangle(device):
    """At 64 steps the vertices are three rows of the table, and every pixel's triangle has its own.

    With perspective the weights are those of the point on its triangle in space. The rasteriser finds them to about
    2⁻⁸ of a pixel (its grid); a triangle is more than 2 pixels wide, so that they are right to 1/200 or so of what the
    light differs by between its corners.
    """
    scene, offset = torus(), (0.3, -0.2)
    found = captured(device, scene, 64, offset=offset)
    points = found.points
    mesh = (
        compile_plan(scene, effects(), Choice(use=("gouraud",), settings={"gouraud": {"tessellation": 64}}))
        .scene.shapes[0]
        .world
    )
    assert len(mesh.positions) > 2048
    material, light = scene.shapes[0].material, scene.lights[0]
    positions, normals = mesh.positions.astype(np.float64), mesh.normals.astype(np.float64)
    view = scene.camera.position - positions
    view /= np.linalg.norm(view, axis=1, keepdims=True)
    count = len(positions)
    base = np.tile(np.array(material.base_color)[:, None], count)
    scalars = [np.full(count, value) for value in (material.metallic, material.roughness, material.specular)]
    source = np.tile(np.array(light.position)[:, None], count)
    lit = exact_direct(light, source, positions.T, normals.T, view.T, base, *scalars).T

    inside = points.hit & (np.sum(points.normal * points.view, axis=-1) > 0)
    corners = mesh.triangles[points.triangle[inside]]
    a, b, c = (positions[corners[:, k]] for k in range(3))
    p = points.position[inside].astype(np.float64)
    normal = np.cross(b - a, c - a)
    square = np.sum(normal * normal, axis=1)
    v = np.sum(np.cross(p - a, c - a) * normal, axis=1) / square
    w = np.sum(np.cross(b - a, p - a) * normal, axis=1) / square
    one, two, three = (lit[corners[:, k]] for k in range(3))
    expected = (1 - v - w)[:, None] * one + v[:, None] * two + w[:, None] * three
    spread = np.ptp([one, two, three], axis=0).max(axis=1, keepdims=True)
    off = np.abs(found.direct[0][inside] - expected)
    assert inside.sum() > 2000
    assert (off <= 0.02 * spread + 1e-4 * expected.max()).mean() > 0.995  # but at an outline, whose triangle is thin
    assert off.max() < 0.5 * expected.max()


def test_given_points_are_lit_as_those_that_were_drawn_there(device):
    choice = Choice(use=("gouraud",), settings={"gouraud": {"tessellation": 16}})
    there, offset = Renderer(device, compile_plan(torus(), effects(), choice), SIZE), (0.3, -0.2)
    drawn = there.capture(offset)
    there.capture((-0.4, 0.45))
    np.testing.assert_array_equal(there.shade(drawn.points, offset).direct[0], drawn.direct[0])


def test_the_error_falls_with_the_square_of_the_tessellation(device):
    """Interpolating linearly leaves a second derivative times Δ²/8. Where n·l or n·v ends there is a kink, left out."""
    scene = torus()
    choice = Choice(use=("interpolated_normals", "lambert"), settings={"interpolated_normals": {"tessellation": 512}})
    true = Renderer(device, compile_plan(scene, effects(), choice), SIZE).capture()
    light = np.array(scene.lights[0].position) - true.points.position
    cosine = np.sum(true.points.normal * light, axis=-1) / np.linalg.norm(light, axis=-1)
    inside = true.points.hit & (np.sum(true.points.normal * true.points.view, axis=-1) > 0.5) & (cosine > 0.4)
    errors = []
    for steps in (32, 128):
        found = captured(device, scene, steps, "lambert")
        off = (found.direct[0] - true.direct[0])[inside & found.points.hit]
        errors.append(np.sqrt(np.mean(off.astype(np.float64) ** 2)))
    assert inside.sum() > 1000
    assert np.log(errors[0] / errors[1]) / np.log(4) == pytest.approx(2, abs=0.15)


def test_it_takes_the_surfaces_place_and_the_direct_lights(device):
    plan = compile_plan(load("torus"), effects(), Choice(use=("gouraud", "flat_shading")))
    assert plan.effects_of("surface") == ("gouraud",) and plan.effect_of("direct") == "gouraud"
    assert "gouraud gives surface" in plan.why_absent("flat_shading")
    assert not any(step.effect == "gouraud" for step in plan.with_true_surface().steps)


def test_it_is_left_out_where_it_would_be_wrong():
    """A vertex knows no texture; and an unlit scene has nothing to interpolate."""
    scene = torus()
    texture = Texture(image([[[250, 20, 30], [10, 200, 40]]]), srgb=True)
    textured = replace(scene.shapes[0], material=replace(scene.shapes[0].material, base_color_texture=texture))
    for other, why in ((replace(scene, shapes=(textured,)), "textures"), (replace(scene, lights=()), "no light")):
        plan = compile_plan(other, effects(), Choice(use=("gouraud",)))
        assert "gouraud" not in plan.effects and why in plan.why_absent("gouraud")
        assert plan.scene is plan.true_scene
