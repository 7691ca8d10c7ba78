"""A store on a full disk, without rights, under a run that is killed: nothing wrong, and nothing lost that was kept."""

import errno
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from lightmeter.groundtruth import batches
from lightmeter.groundtruth.batches import batch_name, reference, series
from lightmeter.groundtruth.store import Store
from lightmeter.scenes.load import load

from .test_store import SIZE, small

FACTS = {"spp": 2, "batches": 12}


@pytest.fixture
def noise(monkeypatch):
    """Renders noise instead of light; gives the twelve batches that a run without faults makes."""

    def render(self, spp, batch):
        return np.random.default_rng([spp, batch]).random((SIZE[1], SIZE[0], 3)).astype(np.float32)

    monkeypatch.setattr(batches.Renderer, "__call__", render)
    return reference(small(), SIZE, **FACTS).batches


def mount(*words: object) -> bool:
    """Whether this machine lets us."""
    return subprocess.run(["mount", *map(str, words)], capture_output=True, check=False).returncode == 0


@pytest.fixture
def tiny_disk(tmp_path):
    """The folder of a file system of 12 KiB."""
    folder = tmp_path / "disk"
    folder.mkdir()
    if sys.platform != "linux" or not mount("-t", "tmpfs", "-o", "size=12k", "tmpfs", folder):
        pytest.skip("this user may mount no file system")
    yield folder
    subprocess.run(["umount", "-l", folder], check=True)


def test_a_full_disk_costs_no_batch(noise, tiny_disk):
    told = []
    found = reference(small(), SIZE, store=Store(tiny_disk, told.append), **FACTS)
    np.testing.assert_array_equal(found.batches, noise)
    assert len(told) == 1
    assert "No space left on device" in told[0]
    assert str(tiny_disk) in told[0]
    kept = list(tiny_disk.rglob("*.exr"))
    assert 0 < len(kept) < 12
    assert not list(tiny_disk.rglob(".unfinished*"))

    assert mount("-o", "remount,size=1m", tiny_disk)
    told.clear()
    again = reference(small(), SIZE, store=Store(tiny_disk, told.append), **FACTS)
    assert again.reused == len(kept)
    np.testing.assert_array_equal(again.batches, noise)
    assert told == []
    assert reference(small(), SIZE, store=Store(tiny_disk), **FACTS).reused == 12


def test_a_store_that_may_only_be_read_is_read(noise, tiny_disk):
    assert mount("-o", "remount,size=1m", tiny_disk)
    store = Store(tiny_disk)
    reference(small(), SIZE, spp=2, batches=5, store=store)
    store.path(series(small(), SIZE, 2), batch_name(1)).write_bytes(b"damaged")
    assert mount("-o", "remount,ro", tiny_disk)
    for _ in range(2):
        told = []
        found = reference(small(), SIZE, store=Store(tiny_disk, told.append), **FACTS)
        assert found.reused == 4
        np.testing.assert_array_equal(found.batches, noise)
        assert len(told) == 2
        assert "it cannot be removed, and is made again" in told[0]
        assert "Read-only file system" in told[1]


def failing(code: int):
    def fail(*_words, **_options):
        raise OSError(code, os.strerror(code))

    return fail


@pytest.mark.parametrize("step", ["mkdir", "read_bytes", "open", "replace"])
@pytest.mark.parametrize("code", [errno.ENOSPC, errno.EROFS, errno.EACCES, errno.EIO], ids=errno.errorcode.get)
def test_a_fault_at_any_step_of_writing(noise, tmp_path, monkeypatch, step, code):
    told = []
    store = Store(tmp_path / "store", told.append)
    with monkeypatch.context() as faults:
        faults.setattr(Path, step, failing(code))
        found = reference(small(), SIZE, store=store, **FACTS)
    np.testing.assert_array_equal(found.batches, noise)
    assert len(told) <= 2  # writing, and where reading fails too, reading
    assert all(os.strerror(code) in message for message in told)
    assert any("cannot be written" in message for message in told)
    assert not list(tmp_path.rglob("*.exr"))
    assert reference(small(), SIZE, store=Store(tmp_path / "store"), **FACTS).reused == 0


@pytest.mark.parametrize("code", [errno.EACCES, errno.EIO], ids=errno.errorcode.get)
def test_a_store_that_cannot_be_read_is_made_again(noise, tmp_path, monkeypatch, code):
    reference(small(), SIZE, store=Store(tmp_path), **FACTS)
    told = []
    monkeypatch.setattr(Path, "read_bytes", failing(code))
    found = reference(small(), SIZE, store=Store(tmp_path, told.append), **FACTS)
    assert found.reused == 0
    np.testing.assert_array_equal(found.batches, noise)
    assert "cannot be read" in told[0]


RUN = """
import sys
from pathlib import Path
from lightmeter.groundtruth.batches import reference
from lightmeter.groundtruth.store import Store
from lightmeter.scenes.load import load
def tell(p):
    print(p.done, p.reused, flush=True)
reference(load("torus"), (16, 12), spp=16, batches=int(sys.argv[2]), store=Store(Path(sys.argv[1])), progress=tell)
"""


def killed(folder: Path, count: int, chance: random.Random) -> int:
    """Kills a run at a random moment, before, while or after it makes up to two batches; how many it had told of."""
    run = subprocess.Popen([sys.executable, "-c", RUN, str(folder), str(count)], stdout=subprocess.PIPE, text=True)
    wanted, done = chance.choice((0, 1, 2)), 0
    assert run.stdout is not None
    for line in run.stdout:
        done, reused = map(int, line.split())
        if done - reused >= wanted:
            break
    time.sleep(chance.expovariate(1 / 0.02))
    run.send_signal(signal.SIGKILL)
    run.communicate()
    return done


@pytest.mark.parametrize("kills", [3, pytest.param(50, marks=pytest.mark.slow)])
def test_a_run_killed_again_and_again_ends_as_one_that_was_not(tmp_path, kills):
    chance, kept = random.Random(kills), 0
    count = 8 + 2 * kills
    for _ in range(kills):
        done = killed(tmp_path, count, chance)
        now = len(list(tmp_path.rglob("batch-*.exr")))
        assert now >= max(kept, done)  # what a run has told of stays
        kept = now
    told = []
    rest = reference(load("torus"), (16, 12), spp=16, batches=count, store=Store(tmp_path, told.append))
    assert rest.reused == kept
    assert told == []
    undisturbed = reference(load("torus"), (16, 12), spp=16, batches=count)
    np.testing.assert_array_equal(rest.batches, undisturbed.batches)
