"""Words that a frame does not heed are answered, and a term that nothing gives names who would."""

import pytest

from lightmeter.absences import remedies, unheard
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import Choice, Plan, compile_plan
from lightmeter.scenes.load import load


def plan_of(scene: str, choice: Choice) -> Plan:
    return compile_plan(load(scene), effects(), choice)


@pytest.mark.parametrize(
    ("choice", "said"),
    [
        (Choice(settings={"pcss": {"resolution": 32}}), "pcss has knobs set, and takes no part: "),
        (Choice(use=("split_sum",)), "split_sum is asked for, and takes no part: the environment is the same"),
        (Choice(only=("texture_filtering", "lambert")), "texture_filtering is asked for, and takes no part: "),
    ],
)
def test_what_was_asked_for_in_vain_is_said(choice: Choice, said: str) -> None:
    (sentence,) = unheard(plan_of("corner", choice), choice)
    assert sentence.startswith(said)
    assert len(sentence) > len(said)


@pytest.mark.parametrize(
    "choice",
    [
        Choice(use=("gtao",), settings={"gtao": {"slices": 2}}),
        Choice(without=("shadow_map",), settings={"shadow_map": {"resolution": 64}}),
    ],
)
def test_what_is_heeded_needs_no_words(choice: Choice) -> None:
    assert unheard(plan_of("corner", choice), choice) == ()


def test_a_term_that_nothing_gives_names_those_that_would() -> None:
    """Neither a baked map, which no material has, nor effects of other terms."""
    (sentence,) = remedies(plan_of("corner", Choice()))
    assert sentence.startswith("Nothing gives environment_visibility: ")
    assert {word for word in sentence.split() if word in effects()} == {"gtao", "ssao", "baked_occlusion"}
    assert remedies(plan_of("corner", Choice(use=("gtao",)))) == ()


def test_an_effect_that_was_left_out_is_replaced_where_another_is_asked_for() -> None:
    (sentence,) = remedies(plan_of("posts", Choice(without=("shadow_map",), use=("gtao",))))
    assert sentence.startswith("Nothing gives visibility: ")
    assert "--use variance_shadow_map" in sentence
