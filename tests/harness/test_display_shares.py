"""Shares of the display chain, on an exact image."""

import numpy as np
import pytest

from lightmeter.display_shares import attribute_display
from lightmeter.groundtruth.oracles import encode, tone
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.display import twin
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.pictures.codes import written
from lightmeter.scenes.load import load

IMAGE = np.linspace(0.0, 2.0, 16 * 16 * 3, dtype=np.float32).reshape(16, 16, 3)
BATCHES = np.stack([IMAGE] * 8)


def plan(*preferred: str, without: tuple[str, ...] = ()):
    return compile_plan(load("plane"), effects(), Choice(use=preferred, without=without))


def test_shares_of_tone_and_encode_by_hand():
    there = plan("gamma_22")
    found = attribute_display(there, BATCHES)
    exposed = IMAGE.astype(np.float64) * 2.0**there.scene.camera.exposure
    toned = twin(there, "tone")(exposed, there.effects["narkowicz"][1])
    exact_tone = tone.evaluate(exposed.astype(np.float32))
    knobs = there.effects["gamma_22"][1]
    truth = encode.evaluate(exact_tone)
    none, only_tone, only_encode = (
        np.mean((np.clip(image, 0, 1) - truth) ** 2)
        for image in (
            written(twin(there, "encode")(toned, knobs), knobs),
            written(twin(there, "encode")(exact_tone, knobs), knobs),
            encode.evaluate(toned),
        )
    )
    shares = {player.name: player.share["mse"].value for player in found.players}
    # float32 images: a difference of 1e-7 of values that differ by 1e-2.
    assert shares["narkowicz"] == pytest.approx(((none - only_tone) + only_encode) / 2, rel=1e-4)
    assert shares["gamma_22"] == pytest.approx(((none - only_encode) + only_tone) / 2, rel=1e-4)
    for metric in ("mse", "flip"):
        assert sum(p.share[metric].value for p in found.players) == pytest.approx(found.total[metric].value, rel=1e-12)


def test_an_exact_encoding_has_its_rounding_s_share():
    """1/(12·255²), and in one order of two twice the mean of 768 products with the tone curve's error."""
    found = {player.name: player.share["mse"].value for player in attribute_display(plan(), BATCHES).players}
    rounding = 1 / 12 / 255**2
    crossed = np.sqrt(rounding * found["narkowicz"] / IMAGE.size)
    assert found["srgb"] == pytest.approx(rounding, abs=4 * (crossed + rounding / np.sqrt(IMAGE.size)))
    assert found["narkowicz"] > 10 * rounding


def test_without_display_effects_there_is_nothing_to_share_out():
    names = tuple(name for name, effect in effects().items() if set(effect.terms) & {"tone", "encode"})
    assert attribute_display(plan(without=names), BATCHES) is None
