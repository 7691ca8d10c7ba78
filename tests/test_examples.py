"""`examples/ci`, run as its README says, in a folder of its own."""

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

from lightmeter.cli import COMMANDS, _parse
from lightmeter.examination.opengl import APT_GL
from lightmeter.examination.truth import APT_LLVM_DEFAULT

EXAMPLE = Path(__file__).parent.parent / "examples" / "ci"


@pytest.fixture(scope="module")
def team(tmp_path_factory) -> Path:
    """A team's repository."""
    unwanted = shutil.ignore_patterns("out", "__pycache__", ".pytest_cache")
    return Path(shutil.copytree(EXAMPLE, tmp_path_factory.mktemp("team") / "repository", ignore=unwanted))


@pytest.fixture
def python(team):
    """Runs `python -m …` there, with a store of its own."""

    def call(*words: str) -> subprocess.CompletedProcess:
        environ = {**os.environ, "LIGHTMETER_STORE": str(team.parent / "store"), "PYTEST_ADDOPTS": ""}
        command = [sys.executable, "-P", "-m", *words]
        return subprocess.run(command, cwd=team, env=environ, capture_output=True, text=True, check=False)

    return call


@pytest.fixture(scope="module")
def commands() -> list[str]:
    """Every command line of the workflow."""
    workflow = yaml.safe_load((EXAMPLE / ".github" / "workflows" / "quality.yml").read_text(encoding="utf-8"))
    steps = workflow["jobs"]["quality"]["steps"]
    return [line for step in steps for line in step.get("run", "").splitlines()]


def words_of(commands: list[str], start: str) -> list[str]:
    """The words after `start` of the only command that begins so."""
    [line] = [line for line in commands if line.startswith(start)]
    return shlex.split(line.removeprefix(start))


def test_the_gate_of_the_workflow_holds(python, team, commands):
    done = python("lightmeter", "gate", *words_of(commands, "lightmeter gate"))
    assert done.returncode == 0, done.stdout + done.stderr
    document = json.loads((team / "out" / "gate.json").read_text())
    found = {(v["metric"], v["regression"]): v["status"] for v in document["verdicts"]}
    assert found == {
        ("flip", None): "PASS",
        ("rmse", None): "PASS",
        ("rmse", 0.1): "PASS",
        ("time_ratio", None): found["time_ratio", None],  # a busy machine may leave it open
    }
    assert (team / "out" / "gate.md").read_text().startswith("### ")
    assert (team / "out" / "gate.xml").exists()


def test_the_tests_of_the_workflow_hold(python, team, commands):
    done = python("pytest", "-p", "no:cacheprovider", *words_of(commands, "python -m pytest"))
    assert done.returncode == 0, done.stdout + done.stderr
    assert "3 passed" in done.stdout
    assert len(list((team / "out" / "tests").glob("*/1/report.md"))) == 3
    assert "lightmeter scenes/courtyard.toml/frame/flip" in (team / "out" / "tests.xml").read_text()


def test_a_coarser_shadow_map_is_noticed(python, team):
    """As the README says: by the limit on the effect, on its region, and by the regression; not by the others."""
    limits = team / "lightmeter.toml"
    text = limits.read_text()
    limits.write_text(text.replace("shadow_map.resolution = 512", "shadow_map.resolution = 64"))
    assert limits.read_text() != text
    done = python("lightmeter", "gate", "--json")
    limits.write_text(text)
    assert done.returncode == 1, done.stdout + done.stderr
    failed = [v["limit"] for v in json.loads(done.stdout)["verdicts"] if v["status"] == "FAIL"]
    assert failed == [
        "rmse <= 0.02",
        "rmse <= 0.03 on object left column, right column",
        "rmse at most 10 % worse than the baseline",
    ]


def test_every_command_in_the_workflow_and_the_readme_exists(commands):
    readme = (EXAMPLE / "README.md").read_text(encoding="utf-8")
    told = [line.partition("#")[0].strip() for line in readme.splitlines()] + re.findall(r"(?<!`)`([^`\n]+)`", readme)
    lines = [line for line in [*commands, *told] if line.startswith("lightmeter ")]
    parsed = [options.command for line in lines if (options := _parse(shlex.split(line)[1:]))]
    assert len(parsed) == len(lines) >= 7
    assert {"doctor", "gate", "store", "compare"} <= set(parsed) <= set(COMMANDS)


def test_the_workflow_installs_what_the_doctor_asks_for(commands):
    installed = words_of(commands, "sudo apt-get install")
    assert {*APT_GL, APT_LLVM_DEFAULT["24.04"]} <= set(installed)
