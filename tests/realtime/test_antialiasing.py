"""Effects for coverage beside supersampling: filters of code values, and how they take part."""

import numpy as np
import pytest

from lightmeter.display_chain import Chained
from lightmeter.realtime.discovery import effect, effects
from lightmeter.realtime.display import twin_of
from lightmeter.realtime.gathering import gathered
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.load import load
from lightmeter.stacking import stack_points
from lightmeter.substitution import players

SIZE = 48
COVERAGE = tuple(name for name, found in effects().items() if found.terms == ("coverage",))
SLOPES = (0.0, 0.07, 0.21, 0.5, 0.83, 1.0)
"""Of edges, rows to columns."""


def half_plane(slope: float, samples: int) -> np.ndarray:
    """(SIZE, SIZE, 3) codes 0.4 above and 0.6 below an edge through the middle, the mean of samples² a pixel."""
    places = (np.arange(SIZE * samples) + 0.5) / samples - SIZE / 2
    below = places[:, None] > slope * places + 0.2
    shares = below.reshape(SIZE, samples, SIZE, samples).mean(axis=(1, 3))
    return np.repeat((0.4 + 0.2 * shares)[..., None], 3, axis=-1)


def rms(image: np.ndarray, exact: np.ndarray) -> float:
    """Away from the borders, where an edge cannot be followed to its end."""
    inner = slice(12, -12), slice(12, -12)
    return float(np.sqrt(np.mean((image - exact)[inner] ** 2)))


@pytest.mark.parametrize("slope", SLOPES)
def test_fxaa_brings_a_slanted_edge_nearer_to_the_box_filter(slope):
    """A slanted one loses a third of its error, a steep one, whose ends are a pixel away, a tenth.

    Along the rows and along the diagonal every pixel of the edge looks alike: it can come no nearer, and is kept.
    """
    knobs = effect("fxaa").settings({"smoothing": 0.0, "reach": 24})
    exact, centre = half_plane(slope, 16), half_plane(slope, 1)
    before, after = rms(centre, exact), rms(twin_of("fxaa", "coverage")(centre, knobs), exact)
    if slope in (0.0, 1.0):
        assert after == before
    else:
        assert after < (2 / 3 if slope <= 0.5 else 0.9) * before


@pytest.mark.parametrize("name", ["fxaa"])
def test_what_has_no_edge_is_kept(name):
    """A ramp of less than a code's threshold a pixel, in colour."""
    ramp = np.linspace(0.2, 0.6, SIZE)
    picture = np.stack([ramp[:, None] + 0 * ramp, ramp * np.ones((SIZE, 1)), 0.5 * ramp[:, None] + 0.3 * ramp], axis=-1)
    knobs = effect(name).settings({})
    assert np.array_equal(twin_of(name, "coverage")(picture, knobs), picture)


@pytest.mark.parametrize("settings", [{}, {"smoothing": 0.0, "threshold": 0.05, "darkest": 0.02}, {"reach": 2}])
def test_fxaa_on_the_device_is_its_twin(device, settings):
    """A code of 8 bits, but where the twin itself decides otherwise for codes that are a float32's rounding off: they
    are whole numbers, and what is compared often ties.
    """
    choice = Choice(use=("fxaa",), settings={"fxaa": settings})
    plan = compile_plan(load("posts"), effects(), choice)
    frame = Renderer(device, plan, (96, 64)).render()
    chain = Chained(plan, frame.radiance.astype(np.float64))
    codes, plain = chain.whole(()) * 255, chain.whole({"fxaa"}) * 255
    rng, tied = np.random.default_rng(1), np.zeros(codes.shape[:2], bool)
    for _ in range(6):
        moved = plain / 255 + rng.normal(0, 2e-7, plain.shape)
        tied |= np.abs(twin_of("fxaa", "coverage")(moved, plan.effects["fxaa"][1]) * 255 - codes).max(axis=-1) > 1
    changed = np.abs(codes - plain).max(axis=-1) > 1
    assert changed.mean() > 0.02 and tied.sum() < 0.2 * changed.sum()
    assert np.abs(frame.display - codes).max(axis=-1)[~tied].max() <= 1.01


def test_a_filter_of_codes_stands_beside_the_samples_and_needs_codes():
    both = compile_plan(load("posts"), effects(), Choice(use=("fxaa",)))
    assert both.steps[-1].effect == "fxaa" and both.steps[-1].reads == ("encode",)
    assert both.sampler == "supersampling" and "coverage" not in both.not_approximated
    assert "fxaa" not in players(both) and "supersampling" in players(both)
    assert "fxaa" not in compile_plan(load("posts"), effects()).effects
    none = compile_plan(load("posts"), effects(), Choice(use=("fxaa",), without=("srgb", "gamma_22")))
    assert none.why_absent("fxaa") == "it filters code values, and nothing in this frame encodes"


def drawn_and_gathered(device, name: str, **settings) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A frame whose samples an effect gathers, what its twin makes of them, and the samples themselves."""
    choice = Choice(use=(name,), without=("shadow_map",), settings={name: settings})
    plan = compile_plan(load("torus"), effects(), choice)
    maker = Renderer(device, plan, (48, 48))
    single = compile_plan(load("torus"), effects(), Choice(without=("shadow_map", *COVERAGE)))
    one = Renderer(device, single, (48, 48))
    samples = []
    for offset in maker.offsets:
        one.offsets = offset[None]
        samples.append(one.render().radiance)
    points = stack_points([one.capture(tuple(offset), terms=False).points for offset in maker.offsets])
    return maker.render().radiance, gathered(plan, np.stack(samples), points), np.stack(samples)


@pytest.mark.parametrize(
    "settings", [{}, {"weigh": True, "frames": 6}, {"clamp": False, "blend": 0.3, "frames": 5}, {"frames": 1}]
)
def test_taa_on_the_device_is_its_twin(device, settings):
    """Sixteen blends of colours of size 1, a dozen roundings each."""
    drawn, twin, _ = drawn_and_gathered(device, "taa", **settings)
    assert np.abs(drawn - twin).max() <= 16 * 12 * np.finfo(np.float32).eps * max(1.0, twin.max())


def test_taa_of_equal_shares_without_a_clamp_is_the_mean_of_its_frames(device):
    """And with its clamp it is not: a silhouette's history is cut."""
    drawn, _, samples = drawn_and_gathered(device, "taa", blend=0.0, clamp=False)
    assert np.abs(drawn - samples.mean(axis=0)).max() <= 16 * 3 * np.finfo(np.float32).eps * max(1.0, samples.max())
    clamped, _, _ = drawn_and_gathered(device, "taa", blend=0.0)
    assert np.abs(clamped - samples.mean(axis=0)).max() > 0.01


@pytest.mark.parametrize("samples", [2, 4, 8])
def test_msaa_on_the_device_is_its_twin(device, samples):
    """The mean of `samples` colours, summed one by one."""
    drawn, twin, all_of_them = drawn_and_gathered(device, "msaa", samples=samples)
    bound = 2 * samples * np.finfo(np.float32).eps * max(1.0, all_of_them.max())
    assert np.abs(drawn - twin).max() <= bound
    edges = np.abs(drawn - all_of_them[0]).max(axis=-1) > bound
    assert 0.02 < edges.mean() < 0.9


def test_a_frame_with_a_history_takes_what_its_next_one_takes(device):
    """One G-buffer, its lighting and one blend, whatever is in the history."""
    times = renderer_of(device, "taa").record(1, 1)
    assert [name for name, effect, _ in times.passes if effect == "taa"] == ["taa"]
    assert times.sampling == ""


def renderer_of(device, name: str) -> Renderer:
    return Renderer(device, compile_plan(load("plane"), effects(), Choice(use=(name,))), (32, 32))


def test_one_effect_chooses_the_samples_and_the_others_say_which():
    plan = compile_plan(load("plane"), effects())
    assert plan.why_absent("taa") == plan.why_absent("msaa") == "supersampling gives coverage already"
    asked = compile_plan(load("plane"), effects(), Choice(use=("taa",)))
    assert asked.why_absent("supersampling") == "taa gives coverage already"
