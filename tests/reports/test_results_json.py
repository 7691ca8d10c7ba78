import dataclasses
import io
import json
import math

import numpy as np
import pytest
from rich.console import Console

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.results import Frame, Results, Together
from lightmeter.reports.results_json import ResultsError, from_json, to_json, write_json
from lightmeter.reports.terminal import comparison_table

from .synthetic_pairs import make_candidates, make_failed, make_results, make_shadows


def test_results_come_back_as_they_were() -> None:
    results = make_results()
    assert from_json(to_json(results)) == results


def test_bytes_per_pixel_are_there_for_who_stores_something() -> None:
    """In the file, and in the log's table."""
    results = make_results()
    storing = dataclasses.replace(results.effects[0], effect="packed_surface", bytes_per_pixel=10)
    results = dataclasses.replace(results, effects=(storing, *results.effects[1:]))
    assert from_json(to_json(results)) == results
    assert [effect["bytes_per_pixel"] for effect in json.loads(to_json(results))["effects"][:2]] == [10, None]
    console = Console(width=160, record=True, file=io.StringIO())
    console.print(comparison_table(results))
    assert console.export_text().count("bytes per pixel") == 1


def test_pairs_that_make_up_for_one_another_come_back_as_they_were() -> None:
    results = make_results()
    assert results.attribution is not None
    pair = Together(("shadow_map", "constant_ambient"), {"mse": Measurement(0.3, 0.2, 0.4)})
    attribution = dataclasses.replace(results.attribution, together=(pair,))
    results = dataclasses.replace(results, attribution=attribution)
    document = to_json(results)
    assert from_json(document) == results
    one = json.loads(document)
    one["attribution"]["together"][0]["names"].pop()
    with pytest.raises(ResultsError, match=r"together\[0\].names: expected a list of 2"):
        from_json(json.dumps(one))


def test_candidates_come_back_as_they_were() -> None:
    results = dataclasses.replace(make_results(), candidates=make_candidates(), failed_candidates=make_failed())
    assert from_json(to_json(results)) == results


def test_shadows_come_back_as_they_were() -> None:
    results = dataclasses.replace(make_results(), shadows=make_shadows()[:1])
    assert from_json(to_json(results)) == results
    part = json.loads(to_json(results))["shadows"][0]["parts"]["dark"]["away"]
    assert (part["pixels"], part["share"]["value"]) == (1234, 0.62)
    with pytest.raises(ResultsError, match=r"shadows\[0\].parts.dark.away.pixels: expected a whole number"):
        from_json(to_json(results).replace('"pixels": 1234', '"pixels": "many"'))


def test_document_has_the_stable_keys() -> None:
    document = json.loads(to_json(make_results()))
    assert list(document)[:3] == ["schema", "scene", "size"]
    assert set(document) >= {"schema", "device", "reference", "frame", "effects", "closure", "left_out", "nonfinite"}
    assert set(document["reference"]) == {"spp", "batches", "seconds", "cached", "truth"}
    assert set(document["frame"]["time_ms"]) == {"median", "mad", "frames"}
    keys = {"effect", "terms", "knobs", "metrics", "time_ms", "share", "bake_ms", "bytes_per_pixel"}
    assert set(document["effects"][0]) == keys
    assert set(document["closure"]) == {"metrics", "bias"}
    assert set(document["nonfinite"]) >= {"frame", "effects"}
    assert document["frame"]["metrics"]["flip"]["floor"] == 0.0041
    assert "floor" not in document["frame"]["metrics"]["rmse"]


def test_numbers_that_are_not_finite_are_strict_json_and_come_back() -> None:
    metrics = {"rmse": Measurement(math.nan, -math.inf, math.inf)}
    text = to_json(Results("s", (1, 1), Frame(metrics)))

    def refuse(word: str) -> None:
        raise AssertionError(word)

    stored = json.loads(text, parse_constant=refuse)["frame"]["metrics"]["rmse"]
    assert (stored["value"], stored["low"], stored["high"]) == ("NaN", "-Infinity", "Infinity")
    back = from_json(text).frame.metrics["rmse"]
    assert math.isnan(back.value)
    assert (back.low, back.high) == (-math.inf, math.inf)


def test_numpy_numbers_are_written_as_numbers() -> None:
    metrics = {"rmse": Measurement(np.float32(0.5), np.float64(0.25), None)}
    results = Results("s", (np.int64(4), 3), Frame(metrics), device={"cores": np.int32(2)})
    document = json.loads(to_json(results))
    assert document["frame"]["metrics"]["rmse"]["value"] == 0.5
    assert document["size"] == [4, 3]
    assert document["device"] == {"cores": 2}


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda d: d.update(schema=2), "results.schema: expected 1, found 2"),
        (lambda d: d.pop("frame"), "results.frame: missing"),
        (lambda d: d["effects"][1].update(terms="x"), "results.effects[1].terms: expected a list"),
        (lambda d: d["frame"]["metrics"]["rmse"].update(value="high"), "results.frame.metrics.rmse.value"),
        (lambda d: d.update(size=[1]), "results.size: expected a list of 2"),
    ],
)
def test_a_wrong_document_is_named(change, said: str) -> None:
    document = json.loads(to_json(make_results()))
    change(document)
    with pytest.raises(ResultsError) as caught:
        from_json(json.dumps(document))
    assert said in str(caught.value)


@pytest.mark.parametrize("text", ["", "{", '{"schema": NaN}', "[]", "3"])
def test_what_is_not_the_document_is_refused(text: str) -> None:
    with pytest.raises(ResultsError):
        from_json(text)


def test_write_leaves_only_the_file(tmp_path) -> None:
    write_json(tmp_path / "results.json", make_results())
    assert [path.name for path in tmp_path.iterdir()] == ["results.json"]


def test_results_are_immutable() -> None:
    with pytest.raises(dataclasses.FrozenInstanceError):
        make_results().scene = "other"
