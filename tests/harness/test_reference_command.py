"""`lightmeter reference`: the truth alone; what a killed run leaves is used by the next one."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from lightmeter.groundtruth import batch_file

PLANE = ("reference", "plane", "--size", "32x24", "--spp", "16")
LONG = ("reference", "cornell-box", "--size", "96x96", "--spp", "256")


def batches(folder: Path) -> list[np.ndarray]:
    """The batches in a folder, in order."""
    return [batch_file.read(path)[0][""] for path in sorted(folder.glob("*.exr"))]


def test_a_reference_says_what_it_is(run, tmp_path):
    found = run(*PLANE, "-o", "truth")
    assert found.code == 0
    assert "16 samples per pixel in 8 batches" in found.out
    assert "not finite: 0" in found.out
    assert "of 8 batches from the store" in found.out
    assert len(batches(tmp_path / "truth")) == 8


def test_json_says_the_same(run, tmp_path):
    run(*PLANE, "-o", "truth")
    document = run(*PLANE, "-o", "truth", "--json").json
    assert document["size"] == [32, 24]
    assert (document["spp"], document["batches"], document["reused"], document["nonfinite"]) == (16, 8, 8, 0)
    assert document["bytes"] == sum(path.stat().st_size for path in (tmp_path / "truth").iterdir())


def test_the_seed_names_the_random_numbers(run, tmp_path):
    for name, seed in (("one", 0), ("same", 0), ("other", 1)):
        run(*PLANE, "-o", name, "--seed", seed, "--no-store")
    one, same, other = (batches(tmp_path / name) for name in ("one", "same", "other"))
    assert all(np.array_equal(a, b) for a, b in zip(one, same, strict=True))
    assert not any(np.array_equal(a, b) for a, b in zip(one, other, strict=True))


def test_a_budget_in_seconds_is_kept_about(run):
    document = run("reference", "plane", "--size", "16x16", "--seconds", "0.5", "-o", "truth", "--json").json
    assert document["batches"] >= 8
    assert document["seconds"] < 5


def test_a_damaged_batch_in_the_store_is_named_and_made_again(run, tmp_path, monkeypatch):
    monkeypatch.setenv("LIGHTMETER_STORE", str(tmp_path / "store"))
    run(*PLANE, "-o", "before")
    victim = sorted((tmp_path / "store").glob("reference/*/*.exr"))[3]
    victim.write_bytes(victim.read_bytes()[:100])
    found = run(*PLANE, "-o", "after")
    assert found.code == 0
    assert victim.name in found.err
    assert "reused 7 of 8 batches" in found.out
    pairs = zip(batches(tmp_path / "before"), batches(tmp_path / "after"), strict=True)
    assert all(np.array_equal(a, b) for a, b in pairs)


def test_an_effect_that_draws_another_surface_takes_a_reference_of_the_true_one(run):
    small = ("control", "--size", "16x16", "--spp", "8")
    assert run("reference", *small, "--true-surface", "-o", "truth").code == 0
    compare = ("compare", *small, "--use", "flat_shading", "--no-shares", "-o", "out", "--reference", "truth")
    found = run(*compare, "--json")
    assert found.code == 0, found.err
    assert found.json["reference"]["cached"]
    assert "flat_shading" in {effect["effect"] for effect in found.json["effects"]}


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory) -> list[np.ndarray]:
    """What an undisturbed run gives, in a process of its own."""
    folder = tmp_path_factory.mktemp("undisturbed")
    command = [sys.executable, "-m", "lightmeter", *LONG, "--no-store", "-o", str(folder)]
    subprocess.run(command, check=True, capture_output=True, timeout=120)
    return batches(folder)


@pytest.mark.parametrize("end", [signal.SIGKILL, signal.SIGINT], ids=lambda end: end.name)
def test_a_run_that_is_stopped_keeps_its_batches(undisturbed, tmp_path, end):
    """Stopped in the middle, the next run continues, says so, and ends with the same bits."""
    store, folder = tmp_path / "store", tmp_path / "truth"
    command = [sys.executable, "-m", "lightmeter", *LONG, "-o", str(folder)]
    environment = os.environ | {"LIGHTMETER_STORE": str(store)}

    def finished() -> int:
        return len(list(store.glob("reference/*/batch-*.exr")))

    # A shell that runs tests in the background ignores SIGINT, and what it starts inherits that.
    process = subprocess.Popen(
        command,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    limit = time.monotonic() + 60
    while finished() < 2 and process.poll() is None and time.monotonic() < limit:
        time.sleep(0.002)
    process.send_signal(end)
    _, said = process.communicate(timeout=60)
    assert process.returncode == (-signal.SIGKILL if end == signal.SIGKILL else 130), said
    if end == signal.SIGINT:
        assert said.splitlines() == ["lightmeter: interrupted; finished batches are kept"]
    kept = finished()
    assert 2 <= kept < 8
    assert not (folder / "manifest.json").exists()

    again = subprocess.run(command, env=environment, capture_output=True, text=True, check=True, timeout=120)
    assert f"reused {kept} of 8 batches" in again.stdout
    assert all(np.array_equal(a, b) for a, b in zip(batches(folder), undisturbed, strict=True))
