"""Environment maps from end to end: which technique is taken, what is said of its baking, and who errs more."""

from dataclasses import replace

import numpy as np
import pytest

from lightmeter.comparison import compare
from lightmeter.options import Budget
from lightmeter.realtime.graph import Choice
from lightmeter.reports.terminal import comparison as words
from lightmeter.scenes.environments import built_in
from lightmeter.scenes.load import load

SMALL = {"split_sum": {"size": 32, "levels": 4, "samples": 32}}


@pytest.fixture(scope="module")
def compared():
    """The torus in the studio, by the default technique and by harmonics."""
    scene = replace(load("torus"), environment=built_in("studio"), lights=())
    found = {}
    for name in ("split_sum", "spherical_harmonics"):
        choice = Choice(use=(name,) if name != "split_sum" else (), settings=SMALL)
        found[name] = compare(scene, (24, 24), Budget(64), choice=choice, shares=False).results
    return found


def test_each_effect_is_judged_by_what_it_gives(compared):
    terms = {effect.effect: effect.terms for effect in compared["split_sum"].effects}
    assert terms["split_sum"] == ("environment",) and terms["constant_ambient"] == ("indirect",)


def test_baking_is_told_apart_from_the_frame(compared):
    by_name = {effect.effect: effect for effect in compared["split_sum"].effects}
    baked = by_name["split_sum"].bake_ms
    assert baked is not None and baked > by_name["split_sum"].time_ms.median
    assert by_name["constant_ambient"].bake_ms is None
    text = "\n".join(str(part) for part in words(compared["split_sum"]).renderables)
    assert "baked once, before the first frame: split_sum " in text


def test_the_split_sum_errs_less_than_harmonics(compared):
    """A lobe of roughness 0.4 to 0.6 under soft boxes: several times less; twice less is asked for."""
    errors = {
        name: next(e for e in results.effects if e.effect == name).metrics["rmse"].value
        for name, results in compared.items()
    }
    assert np.isfinite(list(errors.values())).all()
    assert errors["split_sum"] < 0.5 * errors["spherical_harmonics"]
