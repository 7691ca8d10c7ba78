"""Maps the five top-level folders to one import package, `lightmeter`.

The folders keep their names in the repository (`realtime/`, `metrics/`, …) but install as
`lightmeter.realtime`, `lightmeter.metrics`, …, since bare names such as `metrics` would collide with a
user's own. Sub-packages and their data files are found here, so that a new folder is never dropped from
the wheel.
"""

from pathlib import Path

from setuptools import find_namespace_packages, setup

ROOT = Path(__file__).parent
FOLDERS = {"lightmeter": "harness"} | {
    f"lightmeter.{name}": name for name in ("scenes", "realtime", "groundtruth", "metrics", "reports")
}
DATA = ("*.glsl", "*.vert", "*.frag", "*.geom", "*.toml", "*.html", "*.css", "*.js", "*.json", "*.typed")


def packages() -> list[str]:
    """Every package and sub-package, by its import name."""
    found = []
    for package, folder in FOLDERS.items():
        found.append(package)
        # Folders of shaders hold no Python, and are packages all the same: their files are data of the wheel.
        found += [f"{package}.{name}" for name in find_namespace_packages(str(ROOT / folder))]
    return found


setup(
    package_dir=dict(FOLDERS.items()),
    packages=packages(),
    package_data={"": list(DATA)},
)
