"""The layers that an engine may hand in beside its image, by their documented names.

OpenEXR groups channels by what stands before the last dot: `visibility.0.R`, `visibility.0.G`, `visibility.0.B` are the
layer `visibility.0`. A layer of one value may also be a single channel, `depth.Z`, or bear the layer's name alone.
"""

import re
from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True)
class Layer:
    """What a layer means.

    Attributes:
        term: what it approximates; "" where it is no term of the light transport.
        per_light: whether its name ends in a light's number, as in `lights` of camera.json.
        values: how many values a pixel has; a layer of three may also come with one, for all three.
        meaning: one sentence.
    """

    term: str
    per_light: bool
    values: int
    meaning: str


LAYERS: dict[str, Layer] = {
    "direct": Layer("direct", False, 3, "unshadowed radiance reflected from all lights together"),
    "direct.N": Layer("direct", True, 3, "unshadowed radiance reflected from light N"),
    "visibility.N": Layer("visibility", True, 3, "what is left of light N's reflected radiance with its shadow, 0…1"),
    "environment": Layer("environment", False, 3, "unoccluded radiance reflected from the environment"),
    "ambient_visibility": Layer(
        "environment_visibility", False, 3, "what is left of the environment's reflected radiance with occlusion, 0…1"
    ),
    "indirect": Layer("indirect", False, 3, "radiance scattered by other surfaces, one bounce or more"),
    "transmission": Layer("transmission", False, 3, "radiance mirrored by and refracted through dielectric solids"),
    "emission": Layer("", False, 3, "radiance that the surface itself emits, or the background's"),
    "normal": Layer("", False, 3, "unit shading normal in world space"),
    "depth": Layer("", False, 1, "metres along the camera's forward axis"),
    "position": Layer("", False, 3, "world space, metres"),
    "unsupported": Layer("", False, 1, "above 0 where the engine does not ask to be judged"),
}

_SUFFIXES = (("R", "G", "B"), ("X", "Y", "Z"))
_SINGLE = ("Y", "Z", "V", "R", "X", "A")
_IMAGE = {"R", "G", "B", "A", "Y"}


@dataclass(frozen=True)
class Named:
    """A layer of a file.

    Attributes:
        name: "visibility.0".
        kind: its key in `LAYERS`.
        light: its light's number, None where it has none.
        channels: the names of its one or three channels.
    """

    name: str
    kind: str
    light: int | None
    channels: tuple[str, ...]


def find_layers(channels: Iterable[str]) -> tuple[tuple[Named, ...], tuple[str, ...]]:
    """The documented layers among the channels of a file, and the names of other layers, which are not read."""
    names = list(channels)
    groups: dict[str, list[str]] = {}
    for channel in names:
        if channel in _IMAGE:
            continue
        if channel == "Z":  # where viewers look for depth
            groups.setdefault("depth", []).append(channel)
        elif _kind(channel) is not None:  # a layer of one channel without a suffix
            groups.setdefault(channel, []).append(channel)
        else:
            groups.setdefault(channel.rpartition(".")[0] or channel, []).append(channel)
    found, others = [], []
    for name, members in groups.items():
        kind = _kind(name)
        chosen = _in_order(name, members) if kind else ()
        if kind and chosen:
            number = re.search(r"\.(\d+)$", name)
            found.append(Named(name, kind, int(number[1]) if number else None, chosen))
        else:
            others.append(name)
    return tuple(found), tuple(others)


def _kind(name: str) -> str | None:
    """The key in `LAYERS` of a layer's name."""
    general = re.sub(r"\.\d{1,4}$", ".N", name)
    return general if general in LAYERS else None


def _in_order(name: str, members: list[str]) -> tuple[str, ...]:
    """Its three channels in order, or its single one; empty where they make no layer."""
    for suffixes in _SUFFIXES:
        wanted = tuple(f"{name}.{suffix}" for suffix in suffixes)
        if all(channel in members for channel in wanted):
            return wanted
    single = [m for m in members if m in (name, "Z") or m.rpartition(".")[2] in _SINGLE]
    return (single[0],) if len(members) == 1 and single else ()
