"""What an effect declares: the term it approximates, when a scene needs it, its knobs and its source."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from lightmeter.scenes.errors import closest, listed
from lightmeter.scenes.model import Light, Scene
from lightmeter.scenes.terms import TERMS

from .layout import bytes_per_pixel

STAGES = {
    "samples": "the G-buffer's samples",
    "radiance": "scene-linear frames, one after another",
    "display": "the code values of the encoded picture",
}
"""Where in the frame an effect for `coverage` works."""

KnobValue = float | int | str | bool
Knobs = Mapping[str, KnobValue]


class EffectError(ValueError):
    """An effect or a knob that does not exist, or a value it does not take; the message says what does."""


def nearest(name: str, known: list[str]) -> str:
    """A hint for a misspelt name: "did you mean 'x'?", else the known names."""
    close = closest(name, known)
    return f"did you mean {close!r}?" if close else f"there are: {listed(known)}"


@dataclass(frozen=True)
class Knob:
    """One setting of an effect.

    Attributes:
        name: as in `--set EFFECT.NAME=VALUE`.
        default: its type is the knob's type.
        help: one sentence of explanation.
        unit: "" for a pure number.
        low, high: the range, ends included; None where there is none.
        choices: the values it takes, for a knob that is a choice.
        sweep: the values that `lightmeter sweep` visits unless told otherwise.
    """

    name: str
    default: KnobValue
    help: str
    unit: str = ""
    low: float | None = None
    high: float | None = None
    choices: tuple[KnobValue, ...] = ()
    sweep: tuple[KnobValue, ...] = ()

    def read(self, value: Any, effect: str) -> KnobValue:
        """`value` (text or a number) as this knob's type.

        Raises:
            EffectError: where it is of another type, out of range or not among the choices.
        """
        where = f"{effect}.{self.name}"
        try:
            out = self._convert(value)
        except (TypeError, ValueError):
            kind = {bool: "true or false", int: "a whole number", float: "a number"}.get(type(self.default), "text")
            raise EffectError(f"{where}: expected {kind}, got {value!r}") from None
        if self.choices and out not in self.choices:
            raise EffectError(f"{where}: expected one of {', '.join(map(str, self.choices))}, got {value!r}")
        too_low = self.low is not None and out < self.low
        too_high = self.high is not None and out > self.high
        if isinstance(out, (int, float)) and (too_low or too_high or not np.isfinite(out)):
            raise EffectError(f"{where}: expected a value within {self.range}, got {value!r}")
        return out

    def _convert(self, value: Any) -> KnobValue:
        if isinstance(self.default, bool):
            words = {"true": True, "1": True, "yes": True, "false": False, "0": False, "no": False}
            return words[str(value).lower()] if str(value).lower() in words else int("not a truth value")
        if isinstance(value, bool) and not isinstance(self.default, str):
            raise TypeError("a truth value is no number")
        if isinstance(self.default, int):
            if isinstance(value, float) and not value.is_integer():
                raise ValueError("int() would cut it off")
            return int(value)
        return float(value) if isinstance(self.default, float) else str(value)

    @property
    def range(self) -> str:
        """The range in words: "a | b" or "[low, high]"."""
        if self.choices:
            return " | ".join(map(str, self.choices))
        if isinstance(self.default, bool):
            return "true | false"
        low = "−∞" if self.low is None else f"{self.low:g}"
        high = "∞" if self.high is None else f"{self.high:g}"
        return f"[{low}, {high}]"


def always(_scene: Scene) -> str:
    """No reason to leave the effect out."""
    return ""


@dataclass(frozen=True)
class Effect:
    """The declaration of a real-time approximation. An effect's folder holds it as `EFFECT` in `__init__.py`.

    Attributes:
        name: the folder's name.
        terms: the terms it approximates; judged on their sum where there are several.
        summary: one sentence.
        citation: author, year, title, equation.
        knobs: its settings.
        rank: among effects for the same term the lowest is taken by default.
        channels: the G-buffer channels it reads, see `gbuffer.CHANNELS`.
        reads_scattered: whether it reads the lit frame so far (`scattered_light` in its shader), and so is drawn after
            direct light and the environment.
        verdicts: what may become of a pixel, by the number that its shader leaves in `verdict`: the report splits the
            effect's error by it.
        lights: which lights it handles, for terms of a light.
        unneeded: why this scene does not need it; "" where it does.
        uniforms: values for its shader besides its knobs, from scene, knobs and light (None outside lights).
        defines: what its shader is compiled with, from the knobs: a choice picks a permutation, and what is not chosen
            costs nothing.
        tables: (H, W, 4) float32 arrays that its shader looks up with linear interpolation, from the knobs, by the
            sampler's name.
        part: for terms of the G-buffer and of the display: what of it the effect changes. One effect for each part
            takes part.
        optional: whether it takes part only where it is asked for.
        surface: for `surface`: the scene as it is drawn, from the scene and the knobs.
        stores: for `surface` and `material`: formats of the G-buffer's channels, see `layout.py`, from the knobs.
        stage: for `coverage`: which of `STAGES` it works at. What works on code values filters what the others sampled.
        offsets: for `coverage`: (n, 2) sub-pixel offsets in pixels, right and down, from the knobs.
        masks: for `coverage`: whether its passes mask pixels that further samples need not be lit in.
        folder: where its GLSL lies; found by discovery.
    """

    name: str
    terms: tuple[str, ...]
    summary: str
    citation: str
    knobs: tuple[Knob, ...] = ()
    rank: int = 0
    channels: tuple[str, ...] = ()
    reads_scattered: bool = False
    verdicts: tuple[str, ...] = ()
    lights: Callable[[Scene, Light], bool] = lambda _scene, _light: True
    unneeded: Callable[[Scene], str] = always
    uniforms: Callable[[Scene, Knobs, Light | None], dict[str, Any]] = lambda _scene, _knobs, _light: {}
    defines: Callable[[Knobs], dict[str, object]] = lambda _knobs: {}
    tables: Callable[[Knobs], dict[str, np.ndarray]] = lambda _knobs: {}
    part: str = ""
    optional: bool = False
    surface: Callable[[Scene, Knobs], Scene] | None = None
    stores: Callable[[Knobs], dict[str, str]] = lambda _knobs: {}
    stage: str = "samples"
    offsets: Callable[[Knobs], np.ndarray] | None = None
    masks: bool = False
    folder: Path = field(default=Path(), compare=False)

    def __post_init__(self):
        for term in self.terms:
            if term not in TERMS:
                raise EffectError(f"effect {self.name!r} names the term {term!r}; {nearest(term, list(TERMS))}")
        if self.stage not in STAGES:
            raise EffectError(
                f"effect {self.name!r} works at the stage {self.stage!r}; {nearest(self.stage, list(STAGES))}"
            )

    def settings(self, given: Mapping[str, Any]) -> dict[str, KnobValue]:
        """Every knob's value: those given, read and checked, and the defaults.

        Raises:
            EffectError: for a knob that this effect does not have, or a value that it does not take.
        """
        for name in given:
            self.knob(name)
        return {k.name: k.read(given[k.name], self.name) if k.name in given else k.default for k in self.knobs}

    def bytes_per_pixel(self, knobs: Knobs) -> int | None:
        """What the G-buffer's channels take in the formats that the effect asks for; None where it asks for none."""
        stored = self.stores(knobs)
        return bytes_per_pixel(stored) if stored else None

    def knob(self, name: str) -> Knob:
        """The knob of that name.

        Raises:
            EffectError: where there is none; names the nearest.
        """
        known = {knob.name: knob for knob in self.knobs}
        if name not in known:
            hint = nearest(name, list(known)) if known else "it has no knobs"
            raise EffectError(f"effect {self.name!r} has no knob {name!r}; {hint}")
        return known[name]
