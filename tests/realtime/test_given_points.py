"""Effects at points that were not drawn: the G-buffer is given them."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.scenes.load import load
from lightmeter.scenes.model import Material, Texture

from .small_scenes import LAMP, facing, image, renderer, scene_of

CHECKER = image([[[250, 20, 30], [10, 200, 40]], [[90, 90, 90], [0, 60, 250]]])
TEXTURED = scene_of(facing(Material("card", base_color_texture=Texture(CHECKER, srgb=True))), lights=(LAMP,))


@pytest.mark.parametrize("scene", [TEXTURED, load("posts"), load("torus")], ids=["card", "posts", "torus"])
def test_points_that_were_drawn_give_what_was_drawn(device, scene):
    there = renderer(device, scene)
    drawn = there.capture((0.2, -0.3))
    there.capture((-0.4, 0.1))  # the G-buffer holds something else now
    again = there.shade(drawn.points)
    for kind in ("direct", "visibility", "frame"):
        for key, buffer in getattr(drawn, kind).items():
            np.testing.assert_array_equal(getattr(again, kind)[key], buffer, err_msg=f"{kind} {key}")


def test_other_parameters_are_used(device):
    """Twice the albedo of a Lambert surface is twice the light."""
    scene = scene_of(
        facing(Material("card", specular=0.0, base_color_texture=Texture(CHECKER, srgb=True))), lights=(LAMP,)
    )
    there = renderer(device, scene)
    drawn = there.capture()
    brighter = there.shade(replace(drawn.points, base_color=2 * drawn.points.base_color))
    # One more rounding in float32 than the product itself.
    np.testing.assert_allclose(brighter.direct[0], 2 * drawn.direct[0], rtol=2e-6)
    assert drawn.direct[0].max() > 0.1


def test_nothing_is_seen_where_no_point_is(device):
    there = renderer(device, TEXTURED)
    points = there.capture().points
    nowhere = points.each(np.copy)
    nowhere.shape[:, :16] = -1
    found = there.shade(nowhere)
    assert (found.direct[0][:, :16] == 0).all()
    assert (found.direct[0][8:24, 17:24] > 0).any()


def test_the_buffers_add_up_to_the_frame_whichever_lights_map_was_drawn_last(device):
    """Several lights share a shadow map's texture; a capture draws it anew only where another light's is in it."""
    there = renderer(device, load("posts"))
    frame = there.render().radiance
    for _ in range(2):
        found = there.capture()
        total = found.points.emission.astype(np.float64)
        total += sum(found.direct[light] * found.visibility[light] for light in found.direct)
        total += found.frame["environment"] + found.frame["indirect"]
        # A handful of float32 additions and products.
        np.testing.assert_allclose(total, frame, rtol=16 * 2**-24, atol=1e-7)
