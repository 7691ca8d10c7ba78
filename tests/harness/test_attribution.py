"""Attribution: shares on compositions whose shares are known, and on real scenes, where they must add up."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.stats import binom

from lightmeter.attribution import pairs_that_compensate
from lightmeter.comparison import compare
from lightmeter.families import Layers
from lightmeter.flip_shares import flip_errors
from lightmeter.game import Game
from lightmeter.measuring import clipped
from lightmeter.metrics.flip import ldr_flip
from lightmeter.metrics.registry import measure
from lightmeter.metrics.shapley import every_order, orders_for
from lightmeter.options import Budget
from lightmeter.scenes.load import load
from lightmeter.squared_shares import squared_errors, squared_maps
from lightmeter.substitution import Slot

BATCHES = 8
SIZE = (12, 16)


def noisy(image, rng, sigma, batches=BATCHES):
    return image + sigma * rng.normal(size=(batches, *image.shape))


def additive_game(rng, sigma=0.0, size=SIZE, scales=(0.3, 0.1, 0.02)):
    """Effects that add up; the reference lies off the exact composition by `rest`."""
    count = len(scales)
    names = tuple("abcdefghijklmnop"[:count])
    exact = rng.random((count, *size, 3))
    deltas = rng.normal(scale=np.reshape(scales, (count, 1, 1, 1)), size=(count, *size, 3))
    rest = 0.05 * rng.normal(size=(*size, 3))
    images = tuple(((exact[i] + deltas[i])[None], noisy(exact[i], rng, sigma)) for i in range(count))
    layers = Layers(tuple(Slot("indirect", (name,)) for name in names), np.full((1, *size, 3), 0.1), images)
    reference = noisy(0.1 + exact.sum(axis=0) - rest, rng, sigma)
    game = Game(names, orders_for(count, pairs=8), SimpleNamespace(layers=lambda exact: layers), reference)
    # |rest + Σ Δ|² is shared out as Δ_i · (Σ_j Δ_j + 2 rest), see metrics/shapley.py.
    shares = deltas * (deltas.sum(axis=0) + 2 * rest)
    return game, shares.mean(axis=(1, 2, 3)), shares.mean(axis=3), (rest**2).mean()


def test_shares_of_images_that_add_up_are_those_of_the_closed_form():
    game, shares, maps, residual = additive_game(np.random.default_rng(1))
    errors, found = squared_errors(game), squared_maps(game)
    for i, name in enumerate(game.names):
        assert errors.share(i).value == pytest.approx(shares[i], rel=1e-10)
        np.testing.assert_allclose(found[name], maps[i], atol=1e-6)  # float32
    assert errors.residual().value == pytest.approx(residual, rel=1e-10)
    assert errors.total().value == pytest.approx(shares.sum() + residual, rel=1e-10)


@pytest.mark.parametrize(("opposite", "found"), [(-0.9, [(0, 1)]), (0.9, [])])
def test_players_whose_errors_cancel_are_a_pair(opposite, found):
    """Errors d, -0.9 d and another: d alone exact leaves -0.9 d in place of 0.1 d, both exact leave the other."""
    rng = np.random.default_rng(3)
    d, other = 0.3 * rng.normal(size=(*SIZE, 3)), 0.02 * rng.normal(size=(*SIZE, 3))
    truth = np.zeros((BATCHES, *SIZE, 3))
    images = tuple((error[None], truth) for error in (d, opposite * d, other))
    layers = Layers(tuple(Slot("indirect", (name,)) for name in "abc"), np.zeros((1, *SIZE, 3)), images)
    game = Game(tuple("abc"), orders_for(3), SimpleNamespace(layers=lambda exact: layers), truth)
    errors = squared_errors(game)
    assert pairs_that_compensate(game, {"mse": errors}) == found
    gone = (((1 + opposite) * d + other) ** 2).mean() - (other**2).mean()
    assert errors.removed(0, 1).value == pytest.approx(gone, rel=1e-9)


def test_beyond_ten_players_orders_are_sampled():
    """Of squares, an order and its reverse give the Shapley value itself: nothing is left to sample."""
    game, shares, _, residual = additive_game(np.random.default_rng(7), scales=np.linspace(0.05, 0.3, 12))
    errors = squared_errors(game)
    assert not game.orders.exhaustive
    assert len(game.orders.sets) < 1 << 8
    for i in range(12):
        assert errors.share(i).value == pytest.approx(shares[i], rel=1e-8)
    assert errors.residual().value == pytest.approx(residual, rel=1e-8)


def test_noise_of_both_sides_does_not_bias_shares_and_intervals_cover():
    """400 trials at 8 batches: each player's 95 % interval misses about 20 times; more than 33 in a row of 400 has a
    probability of 0.1 % (binomial)."""
    trials, misses, sums = 400, np.zeros(3), np.zeros(3)
    most = binom.ppf(0.999, trials, 0.05)
    for trial in range(trials):
        rng = np.random.default_rng([2, 0])
        # The same images, other noise.
        game, shares, _, _ = additive_game(rng, 0.0, (4, 4))
        noise = np.random.default_rng([3, trial])
        layers = game.families.layers(())
        images = tuple((approx, noisy(exact[0], noise, 0.2)) for approx, exact in layers.images)
        reference = noisy(game.reference[0], noise, 0.5)
        noisy_layers = Layers(layers.slots, layers.base, images)
        trial_game = Game(game.names, game.orders, SimpleNamespace(layers=lambda _, x=noisy_layers: x), reference)
        errors = squared_errors(trial_game)
        for i in range(3):
            share = errors.share(i)
            misses[i] += not share.low <= shares[i] <= share.high
            sums[i] += share.value - shares[i]
    assert (misses <= most).all(), misses
    # The noise of a mean over 400 trials; without disjoint batches the shares would be off by 0.2²/8 = 5e-3.
    assert (np.abs(sums / trials) < 2e-3).all(), sums / trials


def test_a_product_of_two_effects_shares_what_both_spoil():
    """direct d and visibility v, one pixel: E(∅) = (d'v' − dv)² and so on, by hand."""
    d, v, approximate_d, approximate_v = 2.0, 0.5, 3.0, 1.0
    images = [approximate_d * approximate_v, d * approximate_v, approximate_d * v, d * v]
    stack = tuple(np.full((BATCHES if which & 1 else 1, 1, 1, 3), value) for which, value in enumerate(images))
    layers = Layers((Slot("direct", ("brdf", "shadow"), (0,)),), np.zeros((1, 1, 1, 3)), (stack,))
    game = Game(
        ("brdf", "shadow"),
        every_order(2),
        SimpleNamespace(layers=lambda _: layers),
        np.full((BATCHES, 1, 1, 3), d * v),
    )
    none, brdf, shadow, both = ((image - d * v) ** 2 for image in images)
    errors = squared_errors(game)
    assert errors.share(0).value == pytest.approx(((none - brdf) + (shadow - both)) / 2)
    assert errors.share(1).value == pytest.approx(((none - shadow) + (brdf - both)) / 2)
    assert errors.removed(1).value == pytest.approx(none - shadow)


def test_flip_of_a_set_is_that_of_its_picture_and_players_that_change_nothing_cost_nothing(monkeypatch):
    game, *_ = additive_game(np.random.default_rng(5), size=(32, 32))
    layers = game.families.layers(())
    unchanged = (layers.images[1][1][:1], layers.images[1][1])
    layers = Layers(layers.slots, layers.base, (layers.images[0], unchanged, layers.images[2]))
    game = Game(game.names, game.orders, SimpleNamespace(layers=lambda _: layers), game.reference)
    calls = []
    monkeypatch.setattr("lightmeter.flip_shares.FlipAgainst", counted(calls))
    errors, maps = flip_errors(game, clipped)
    for place, players in enumerate(game.orders.sets):
        image = sum(part.mean(axis=0) for part in layers.parts(game.exact(int(players))))
        expected = ldr_flip(clipped(image), clipped(game.reference.mean(axis=0))).mean(dtype=float)
        assert errors.full[place] == pytest.approx(expected, rel=1e-5)  # float32 sums
    # Eight weighted errors of at most 1 cancel, but for float64's rounding.
    assert abs(errors.share(1).value) < 8 * np.finfo(float).eps
    assert len(calls) == 4 * 7  # of eight sets four pictures, at the mean, two halves and four quarters
    for i, name in enumerate(game.names):
        assert maps[name].mean(dtype=float) == pytest.approx(errors.share(i).value, abs=1e-6)


def counted(calls):
    from lightmeter.metrics.flip import FlipAgainst

    class Counted(FlipAgainst):
        def __call__(self, tested):
            calls.append(1)
            return super().__call__(tested)

    return Counted


@pytest.fixture(scope="module", params=["cornell-box", "torus"])
def outcome(request):
    return compare(load(request.param), (32, 32), Budget(16))


def test_shares_and_residual_add_up_to_the_frames_error(outcome):
    attribution = outcome.results.attribution
    for metric in ("mse", "flip"):
        total = attribution.total[metric].value
        parts = [player.share[metric].value for player in attribution.players]
        assert sum(parts) + attribution.residual[metric].value == pytest.approx(total, rel=1e-12)
        # The same number as the metric itself gives; FLIP's maps are float32, and summed in another order.
        display = {"display": outcome.display} if metric == "flip" else {}
        alone = measure(metric, outcome.frame.radiance, outcome.reference, **display)
        assert total == pytest.approx(alone.value, rel=1e-6 if metric == "flip" else 1e-9)


def test_the_residual_is_the_closure(outcome):
    closure, residual = outcome.results.closure.metrics["rmse"], outcome.results.attribution.residual["mse"]
    assert closure.value**2 == pytest.approx(max(0.0, residual.value), rel=1e-4, abs=1e-9)
    assert residual.low <= 0 <= residual.high


def test_players_are_effects_and_terms_that_nothing_approximates(outcome):
    players = {player.name: player for player in outcome.results.attribution.players}
    effects = {effect.effect: effect for effect in outcome.results.effects}
    for name, player in players.items():
        assert player.approximated == (name in effects)
        if player.approximated:
            assert effects[name].share == player.share
    unapproximated = {name for name, player in players.items() if not player.approximated}
    assert unapproximated == set(outcome.results.not_approximated)
    assert effects["narkowicz"].share == {}


def test_an_exact_effect_has_no_share(outcome):
    """Cook-Torrance's closed form is the oracle's, up to float32: a relative 1e-6 of the frame's error at most."""
    shares = {p.name: p.share["mse"].value for p in outcome.results.attribution.players}
    if "cook_torrance" in shares:
        assert abs(shares["cook_torrance"]) < 1e-5 * outcome.results.attribution.total["mse"].value


def test_without_shares_the_closure_is_the_same(outcome):
    plain = compare(load(outcome.results.scene), (32, 32), Budget(16), shares=False)
    assert plain.results.attribution is None
    assert plain.shares is None
    found, known = plain.results.closure.bias, outcome.results.closure.bias
    assert found.value == pytest.approx(known.value, abs=1e-6)


def test_a_frame_that_is_not_finite_has_no_shares(monkeypatch):
    from lightmeter.realtime.renderer import Renderer

    render = Renderer.render

    def spoilt(self):
        frame = render(self)
        radiance = frame.radiance.copy()
        radiance[0, 0, 0] = np.nan
        return type(frame)(radiance, frame.display)

    monkeypatch.setattr(Renderer, "render", spoilt)
    found = compare(load("plane"), (16, 16), Budget(8))
    assert found.results.attribution is None
    assert found.results.nonfinite.frame == 1


def test_pictures_come_in_the_order_that_effects_are_drawn_in(outcome):
    """Not in one that differs from run to run."""
    drawn = list(dict.fromkeys(step.effect for step in outcome.plan.steps))
    assert [name for name in outcome.sides if name in drawn] == [name for name in drawn if name in outcome.sides]
