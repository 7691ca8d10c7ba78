"""A limit in one line of text: "flip <= 0.12", "shadow_map.rmse <= 0.02 on object ball"."""

import re

from lightmeter.conditions import Conditions
from lightmeter.failures import UsageError
from lightmeter.limit import FRAME, Limit
from lightmeter.regions import EVERYWHERE, Region

_FORM = re.compile(
    r"\s*(?:(?P<of>[\w-]+(?:\.\d+)?)\.)?(?P<metric>[A-Za-z]\w*)(?:\s+to\s+(?P<to>[\w-]+))?"
    r"\s*(?P<sign><=|>=)\s*(?P<number>[-+.\w]+)"
    r"(?:\s+(?:(?P<surfaces>without\s+background)|on\s+(?P<kind>object|material)\s+(?P<names>.+?)))?\s*"
)

FORM = "[EFFECT.]METRIC <= NUMBER, or >=, such as 'flip <= 0.12', 'shadow_map.rmse <= 0.02 on object ball'"


def parse_limit(text: str, conditions: Conditions, scene: str = "", place: str = "") -> Limit:
    """The limit that a line of text means.

    Args:
        text: `[EFFECT.]METRIC [to EFFECT] <=|>= NUMBER [without background | on object|material NAME, NAME]`.
        place: for messages; the text itself where it is empty.

    Raises:
        UsageError: it is none.
    """
    place = place or f"limit {text!r}"
    match = _FORM.fullmatch(text)
    if match is None:
        raise UsageError(f"{place}: expected {FORM}")
    try:
        number = float(match["number"])
    except ValueError:
        number = float("nan")
    if not abs(number) < float("inf"):
        raise UsageError(f"{place}: expected a finite number after {match['sign']}, got {match['number']!r}")
    region = EVERYWHERE
    if match["surfaces"]:
        region = Region("surfaces")
    elif match["kind"]:
        names = tuple(name.strip() for name in match["names"].split(","))
        region = Region(match["kind"], names)
    high, low = (number, None) if match["sign"] == "<=" else (None, number)
    return Limit(
        place, scene, match["of"] or FRAME, match["metric"], high, low, conditions, to=match["to"], region=region
    )
