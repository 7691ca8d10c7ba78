"""The command line as a user meets it, in this process."""

import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from lightmeter.cli import main


@dataclass(frozen=True)
class Ran:
    """What a command left: its exit code and what it printed."""

    code: int
    out: str
    err: str

    @property
    def json(self):
        """The one JSON document on stdout."""
        return json.loads(self.out)


Run = Callable[..., Ran]


@pytest.fixture(scope="session")
def shared_store(tmp_path_factory) -> Path:
    """A store that the tests share, so that one reference serves many."""
    return tmp_path_factory.mktemp("store")


@pytest.fixture
def run(capsys, monkeypatch, tmp_path, shared_store) -> Run:
    """Runs `lightmeter` with these words, in a folder of its own."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("LIGHTMETER_STORE", str(shared_store))

    def call(*words: object) -> Ran:
        capsys.readouterr()
        code = main([str(word) for word in words])
        printed = capsys.readouterr()
        return Ran(code, printed.out, printed.err)

    return call


@pytest.fixture
def refused(run) -> Callable[..., str]:
    """Runs a command that must end with exit code 2 and one message, and nothing else; gives the message."""

    def call(*words: object) -> str:
        found = run(*words)
        lines = found.err.splitlines()
        assert found.code == 2, found
        assert found.out == "", found.out
        assert len(lines) == 1, found.err
        assert lines[0].startswith("lightmeter: error: "), found.err
        assert len(lines[0]) < 700
        return lines[0].removeprefix("lightmeter: error: ")

    return call
