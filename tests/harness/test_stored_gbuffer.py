"""The G-buffer's formats as players: each is exact by itself, and their own errors are those of the picture alone."""

import numpy as np
import pytest

from lightmeter.options import Budget
from lightmeter.progress import silent
from lightmeter.realtime.device import Device
from lightmeter.realtime.graph import Choice
from lightmeter.scenes import shapes
from lightmeter.scenes.model import Image, Material, Shape, Texture
from lightmeter.sides import FramePoints, effect_sides
from lightmeter.truth import Truth
from tests.realtime.small_scenes import LAMP, camera, renderer, scene_of

SIZE = (32, 32)
SURFACE, MATERIAL, FILTERING = "packed_surface", "packed_material", "texture_filtering"
CHOICE = Choice(use=(SURFACE, MATERIAL), settings={SURFACE: {"position": "depth", "normal": "oct8"}})


@pytest.fixture(scope="module")
def at() -> FramePoints:
    """A ball with a fine texture, under one point light."""
    noise = np.random.default_rng(3).integers(0, 256, (64, 64, 3), dtype=np.uint8)
    texture = Texture(Image(noise, "noise"), srgb=True, min_filter="linear_mipmap_linear")
    ball = Shape("ball", shapes.sphere(0.8, 32, 16), Material("noisy", roughness=0.5, base_color_texture=texture))
    scene = scene_of(ball, view=camera(ymag=1.0), lights=(LAMP,))
    return FramePoints.of(renderer(Device(), scene, SIZE, CHOICE), Truth(scene, SIZE, Budget(spp=8)))


def test_each_of_them_is_exact_by_itself(at):
    """Surface, material and texture filtering change channels of their own, in every combination."""
    everyone = at.variants.everyone
    assert everyone == {SURFACE, MATERIAL, FILTERING}
    exact, hit = at.seen(everyone).points, at.points.hit

    def same(name: str, players: set[str]) -> bool:
        # Unfiltered parameters come with a normal that the truth interpolates: some 1e-5 from the rasteriser's.
        there, here = getattr(at.seen(players).points, name)[hit], getattr(exact, name)[hit]
        return bool(np.abs(there.astype(np.float64) - here).max() < 1e-4)

    for players in ({SURFACE}, {SURFACE, MATERIAL}, {SURFACE, FILTERING}):
        assert same("normal", players) and same("position", players) and not same("base_color", players)
    for players in ({MATERIAL, FILTERING},):
        assert same("base_color", players) and not same("normal", players)
    stored = at.seen({FILTERING, SURFACE}).points.base_color[hit]
    assert np.abs(stored - exact.base_color[hit]).max() < 0.004  # half a code of 255, where sRGB is steepest


def test_their_own_errors_have_no_noise_and_are_small(at):
    """Direct light of a point is a closed form, and what is left of the noise is the same on both sides."""
    sides = effect_sides(at.variants.renderer, at.variants.truth, silent, at)
    for name in (SURFACE, MATERIAL):
        differences = [
            np.asarray(a, np.float64) - b for a, b in zip(sides[name].tested, sides[name].truth, strict=True)
        ]
        assert 1e-5 < np.sqrt(np.mean(np.square(differences[0]))) < 0.02
        spread = np.std(differences, axis=0).mean()
        assert spread < 0.05 * np.abs(differences[0]).mean()
    filtering = np.mean(sides[FILTERING].tested, axis=0) - np.mean(sides[FILTERING].truth, axis=0)
    assert np.sqrt(np.mean(filtering**2)) > 0.02
