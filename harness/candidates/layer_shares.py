"""How much of an engine's error each of its layers causes, where its layers add up to its frame."""

from dataclasses import replace

import numpy as np

from lightmeter.attribution import Shares, attribute
from lightmeter.candidates.handed import Display
from lightmeter.candidates.judging import Judged
from lightmeter.candidates.layer_buffers import Centres, as_capture
from lightmeter.families import Layers, composition, layers_at
from lightmeter.progress import Report, silent
from lightmeter.realtime.graph import FACTORS
from lightmeter.scenes.features import missing_terms
from lightmeter.substitution import Slot

CLOSE = 0.05
"""By how much of the frame's mean the layers' sum may differ from the frame, in the root mean square: edges that the
frame smooths and the layers, sampled at centres, do not."""


def layer_shares(
    judged: Judged, centres: Centres, reference: np.ndarray, display: Display, report: Report = silent
) -> tuple[Shares | None, str]:
    """The Shapley shares of terms, and a sentence where there are none.

    A term without a layer is a player that is not approximated, as in our own frames. What the layers leave of the
    frame stays in every set and ends up in the residual.
    """
    names = judged.handed.layers
    if not any(name.startswith(("direct.", "environment", "indirect", "transmission")) for name in names):
        return None, ""
    if judged.mask is not None or judged.handed.display is not None:
        return None, "No shares: they need a scene-linear frame without masked pixels."
    slots = _slots(centres)
    captures = [as_capture(judged.handed, centres.points)]
    layers = layers_at(slots, centres.points, captures, centres.exact, centres.truth)
    rest = judged.image - composition(layers, ())
    off = float(np.sqrt(np.mean(rest**2)) / max(float(np.mean(judged.image)), 1e-12))
    if not off <= CLOSE:
        return (
            None,
            f"No shares: the layers' sum is {100 * off:.0f} % of the mean away from the frame (RMS; at most 5 %).",
        )
    fixed = _Fixed(replace(layers, base=layers.base + rest))
    players = {player: (player,) for slot in slots for player in slot.players}
    given = {term for term in players if _is_given(term, judged, centres)}
    return attribute(players, dict.fromkeys(given), fixed, reference, display, report), ""


class _Fixed:
    """The layers of one variant of the G-buffer, whoever is exact."""

    def __init__(self, layers: Layers) -> None:
        self._layers = layers

    def layers(self, _exact) -> Layers:
        return self._layers


def _slots(centres: Centres) -> tuple[Slot, ...]:
    """The summands that the scene has; a term stands for itself."""
    scene = centres.truth.scene
    missing = missing_terms(scene)

    def players(term: str) -> tuple[str, ...]:
        return tuple(t for t in (term, FACTORS.get(term)) if t is not None and t not in missing)

    lights = tuple(range(len(scene.all_lights)))
    return tuple(
        Slot(term, players(term), lights if term == "direct" else ())
        for term in ("direct", "environment", "indirect", "transmission")
        if term not in missing
    )


def _is_given(term: str, judged: Judged, centres: Centres) -> bool:
    """Whether the engine handed in a term, for some light at least."""
    capture = as_capture(judged.handed, centres.points)
    return bool(
        {"direct": capture.direct, "visibility": capture.visibility}.get(term) or capture.frame.get(term) is not None
    )
