"""Checks that a wheel holds every tracked file of the packages' folders, and no file besides.

    python .ci/check_wheel.py [WHEEL]

Without WHEEL, one is built from the tracked files alone, so that neither untracked files nor the left-overs of
an earlier build can hide that one is missing.
"""

import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SUBPACKAGES = ("scenes", "realtime", "groundtruth", "metrics", "reports")
FOLDERS = {"harness": "lightmeter"} | {name: f"lightmeter/{name}" for name in SUBPACKAGES}


def tracked_files() -> list[str]:
    """Files that git tracks, as paths from the root; those removed and not yet committed are left out."""
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True)
    return [name for name in listed.stdout.split("\0") if name and (ROOT / name).is_file()]


def build_wheel(folder: Path) -> Path:
    """A wheel of the tracked files, built without network by the setuptools of this environment."""
    source = folder / "source"
    for name in tracked_files():
        target = source / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / name, target)
    command = [sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", str(folder), str(source)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(f"the wheel was not built:\n{done.stdout}{done.stderr}")
    return next(folder.glob("*.whl"))


def expected_members() -> set[str]:
    """The tracked files of the packages' folders, by the path they have once installed."""
    members = set()
    for name in tracked_files():
        folder, _, rest = name.partition("/")
        if rest and folder in FOLDERS:
            members.add(f"{FOLDERS[folder]}/{rest}")
    return members


def wheel_members(wheel: Path) -> set[str]:
    """What the wheel installs, its metadata aside."""
    with zipfile.ZipFile(wheel) as archive:
        names = [name for name in archive.namelist() if not name.endswith("/")]
    return {name for name in names if ".dist-info/" not in name}


def complaints(wheel: Path) -> list[str]:
    """What is wrong with a wheel, a line each; nothing where it is right."""
    expected, found = expected_members(), wheel_members(wheel)
    missing = [
        f"not in the wheel (does setup.py find its folder, and is its suffix in DATA?): {name}"
        for name in expected - found
    ]
    foreign = [f"in the wheel, and tracked nowhere: {name}" for name in found - expected]
    return sorted(missing) + sorted(foreign)


def main(arguments: list[str]) -> int:
    """Check the wheel that is given, or one built here; 0 where it is right."""
    with tempfile.TemporaryDirectory() as folder:
        wheel = Path(arguments[0]) if arguments else build_wheel(Path(folder))
        wrong = complaints(wheel)
        count = len(wheel_members(wheel))
    print("\n".join(wrong) if wrong else f"{wheel.name}: {count} files, as tracked")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
