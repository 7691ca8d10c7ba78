"""`lightmeter store`: what is there, and what `prune` takes away."""

import os
import time

import pytest


@pytest.fixture
def filled(run, tmp_path, monkeypatch):
    """A store with two references: a small old one and a larger new one."""
    monkeypatch.setenv("LIGHTMETER_STORE", str(tmp_path / "store"))
    assert run("reference", "plane", "--size", "8x8", "--spp", "8", "-o", "a").code == 0
    for path in (tmp_path / "store").glob("*/*/*.exr"):
        week = time.time() - 7 * 86400
        os.utime(path, (week, week))
    assert run("reference", "plane", "--size", "32x32", "--spp", "8", "-o", "b").code == 0
    return run


def sizes(run) -> list[str]:
    return [entry["size"] for entry in run("store", "--json").json["entries"]]


def test_the_list_says_what_there_is(filled):
    found = filled("store")
    assert found.code == 0
    assert "32×32" in found.out
    assert "7 d" in found.out
    assert "16 files of 2 series" in found.out
    assert found.out == filled("store", "list").out


def test_the_list_as_json(filled, tmp_path):
    document = filled("store", "--json").json
    assert document["folder"] == str(tmp_path / "store")
    assert [entry["size"] for entry in document["entries"]] == ["32x32", "8x8"]
    assert document["bytes"] == sum(entry["bytes"] for entry in document["entries"])
    assert document["bytes"] == sum(path.stat().st_size for path in (tmp_path / "store").glob("*/*/*.exr"))
    keys = {"kind", "scene", "size", "spp", "batches", "bytes", "age", "key"}
    assert all(entry.keys() == keys for entry in document["entries"])


def test_an_empty_store_is_no_error(run, tmp_path, monkeypatch):
    monkeypatch.setenv("LIGHTMETER_STORE", str(tmp_path / "nothing"))
    assert run("store").code == 0
    assert run("store", "prune", "--all").code == 0
    assert run("store", "--json").json["entries"] == []


@pytest.mark.parametrize(
    ("words", "left"),
    [
        (("--older-than", "3d"), ["32x32"]),
        (("--older-than", "8d"), ["32x32", "8x8"]),
        (("--larger-than", "all but a byte"), ["32x32"]),
        (("--larger-than", "1GB"), ["32x32", "8x8"]),
        (("--all",), []),
    ],
)
def test_prune_takes_away_what_it_says(filled, words, left):
    total = filled("store", "--json").json["bytes"]
    found = filled("store", "prune", *(word.replace("all but a byte", f"{total - 1}B") for word in words), "--json")
    assert found.code == 0
    assert sizes(filled) == left
    assert len(found.json["removed"]) == 2 - len(left)


def test_prune_by_key(filled):
    small = filled("store", "--json").json["entries"][1]
    found = filled("store", "prune", "--key", small["key"][:12])
    assert "8×8" in found.out
    assert "removed from" in found.out
    assert sizes(filled) == ["32x32"]
