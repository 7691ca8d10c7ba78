"""What is installed is what is tracked, and asking for help loads no renderer."""

import importlib.util
import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
HEAVY = ("mitsuba", "drjit", "moderngl", "colour", "skimage", "scipy", "OpenEXR", "PyOpenColorIO", "plotly")


@pytest.fixture(scope="module")
def check_wheel():
    """The script that CI runs on the wheel."""
    spec = importlib.util.spec_from_file_location("check_wheel", ROOT / ".ci" / "check_wheel.py")
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def wheel(check_wheel, tmp_path_factory) -> Path:
    """A wheel of the tracked files."""
    if shutil.which("git") is None or not (ROOT / ".git").exists():
        pytest.skip("not a git checkout: nothing tells which files are tracked")
    return check_wheel.build_wheel(tmp_path_factory.mktemp("wheel"))


def test_the_wheel_holds_every_tracked_file_and_no_other(check_wheel, wheel):
    assert check_wheel.complaints(wheel) == []


def test_a_file_that_the_wheel_lacks_is_named(check_wheel, wheel, monkeypatch):
    tracked = [*check_wheel.tracked_files(), "realtime/effects/new/pass.spirv"]
    monkeypatch.setattr(check_wheel, "tracked_files", lambda: tracked)
    assert any(line.endswith("lightmeter/realtime/effects/new/pass.spirv") for line in check_wheel.complaints(wheel))


def test_every_folder_is_checked(check_wheel):
    """A sixth folder that setup.py installs would be checked too."""
    text = (ROOT / "setup.py").read_text()
    assert all(f'"{name}"' in text for name in check_wheel.FOLDERS)
    packages = {path.parent.name for path in ROOT.glob("*/__init__.py")}
    assert packages - {"tests", "benchmarks"} == set(check_wheel.FOLDERS)


def test_help_loads_no_renderer_and_no_heavy_library():
    source = (
        "import json, runpy, sys\n"
        "sys.argv = ['lightmeter', '--help']\n"
        "try:\n"
        "    runpy.run_module('lightmeter', run_name='__main__', alter_sys=True)\n"
        "except SystemExit as end:\n"
        "    code = end.code\n"
        f"print('loaded', json.dumps([code or 0, [name for name in {HEAVY} if name in sys.modules]]))\n"
    )
    done = subprocess.run([sys.executable, "-P", "-c", source], capture_output=True, text=True, check=False)
    last = done.stdout.splitlines()[-1]
    assert last.startswith("loaded "), done.stdout + done.stderr
    assert json.loads(last.removeprefix("loaded ")) == [0, []]
    assert "compare" in done.stdout


@pytest.mark.parametrize(
    ("source", "unneeded"),
    [
        ("from lightmeter.cli import main; main(['scenes'])", ("pydantic", "mitsuba", "moderngl")),
        (
            "import lightmeter.comparison",
            ("lightmeter.scenes.export", "lightmeter.metrics.registration", "scipy.ndimage"),
        ),
    ],
)
def test_what_a_command_does_not_need_it_does_not_load(source, unneeded):
    """Listing the scenes builds none, and what candidates need waits for one."""
    source += f"; import sys; print('loaded', [name for name in {unneeded} if name in sys.modules])"
    done = subprocess.run([sys.executable, "-P", "-c", source], capture_output=True, text=True, check=False)
    assert done.stdout.splitlines()[-1:] == ["loaded []"], done.stdout + done.stderr


def test_nothing_in_the_tree_hides_the_package(tmp_path):
    """The working directory's folders have bare names; the package is found by its own, wherever one stands."""
    source = "import lightmeter.scenes, lightmeter.metrics; print(lightmeter.scenes.__name__)"
    for folder in (ROOT, tmp_path):
        command = [sys.executable, "-c", source]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        assert done.stdout.strip() == "lightmeter.scenes", done.stderr
