"""Every loader answers damaged files with a result or a documented error: soon, in little memory, with no warning."""

import os
import time
from pathlib import Path
from random import Random

import pytest

from . import running
from .loaders import Loader, loaders, put_neighbours
from .mutation import mutated
from .running import fault, fuzz

CASES = sorted(Path(__file__).parent.glob("cases/*"))


@pytest.mark.parametrize("name", loaders())
def test_sound_files_are_read(tmp_path, name):
    put_neighbours(tmp_path)
    loader = loaders()[name]
    for sound in loader.seeds:
        (tmp_path / loader.file).write_bytes(sound)
        assert fault(loader, tmp_path / loader.file) is None
        assert loader.repair(sound) == sound


@pytest.mark.parametrize("name", loaders())
def test_a_few_damaged_files(name):
    outcome = fuzz(loaders()[name], 60)
    assert outcome.findings == ()
    assert outcome.read + outcome.refused == 60
    assert outcome.refused > 10


@pytest.mark.slow
@pytest.mark.parametrize("name", loaders())
def test_many_damaged_files(name):
    assert fuzz(loaders()[name], 12_000, seed=1).findings == ()


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_what_was_found_once(tmp_path, case):
    loader = loaders()[case.name.partition("-")[0]]
    put_neighbours(tmp_path)
    (tmp_path / loader.file).write_bytes(case.read_bytes())
    assert not fault(loader, tmp_path / loader.file)


def planted(read) -> Loader:
    return Loader("planted", "file", (b"a sound file",), read)


def divide(path):
    return 1 // 0


def hang(path):
    time.sleep(60)


def swallow(path):
    return bytearray(3 << 30)


def crash(path):
    os.abort()


@pytest.mark.parametrize(
    ("read", "inputs", "what"),
    [
        (divide, 3, "ZeroDivisionError"),
        (hang, 2, "no answer within 0.2 s"),
        (swallow, 3, "MemoryError"),
        (crash, 3, "the process ended with -6"),
    ],
)
def test_planted_faults_are_found_once_each(monkeypatch, read, inputs, what):
    monkeypatch.setattr(running, "SECONDS", 0.2)
    outcome = fuzz(planted(read), inputs)
    assert [finding.what.startswith(what) for finding in outcome.findings] == [True]
    assert (outcome.read, outcome.refused) == (0, 0)
    assert len(outcome.findings[0].data) < 2000


def test_an_input_follows_from_its_number():
    sound = b"[camera]\nyfov = 40\n" * 5
    files = [mutated(sound, Random(f"toml 0 {number}")) for number in range(200)]
    assert files == [mutated(sound, Random(f"toml 0 {number}")) for number in range(200)]
    assert len(set(files)) > 150  # a few mutations undo each other, or change nothing
