"""Options that are lists: given twice, they hold what both said."""

import pytest

from lightmeter.cli import Parser
from lightmeter.commands import compare, diff, stress, sweep
from lightmeter.options import Words, words


def parsed(command, *arguments: str):
    parser = Parser()
    command.add_options(parser)
    return parser.parse_args(arguments)


@pytest.mark.parametrize("option", ["only", "without", "use"])
@pytest.mark.parametrize(("command", "first"), [(compare, ("plane",)), (sweep, ("plane", "srgb"))])
def test_the_choice_of_effects_adds_up(command, first, option):
    given = parsed(command, *first, f"--{option}", "srgb, lambert", f"--{option}", "gtao")
    assert words(given) == Words(**{option: ("srgb", "lambert", "gtao")})
    assert words(parsed(command, *first)) == Words(), "what one call was given is not the next one's default"


def test_settings_add_up():
    given = ("--set", "a.b=1", "--set", "a.c=2", "--set", "d.b=3", "--set", "a.b=1")
    assert words(parsed(compare, "plane", *given)).settings == {"a": {"b": "1", "c": "2"}, "d": {"b": "3"}}


def test_other_lists_add_up():
    assert parsed(diff, "a", "b", "--metric", "rmse,mae", "--metric", "flip").metric == ["rmse", "mae", "flip"]
    assert parsed(compare, "plane", "--register", "flip", "--register", "transfer").register == ["flip", "transfer"]
    assert parsed(stress, "--input", "a=1", "--input", "b=2").input == ["a=1", "b=2"]
    assert parsed(stress, "--scenes", "far", "--scenes", "dust").scenes == ["far", "dust"]
    assert parsed(stress, "--scenes").scenes == [], "all"
