"""The exact commands that install what lacks."""

import importlib.metadata
import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Sequence

ARCHIVE_LINE = re.compile(r"^ +\d+ (?!/var/lib/dpkg/status)")
"""A line of `apt-cache policy` that names where a version comes from, other than from being installed."""


def package_manager() -> str:
    """The package manager of this system, by the name of its command; empty where it is none of those known."""
    return next((name for name in ("apt-get", "dnf", "brew") if shutil.which(name)), "")


def system_packages(packages: Sequence[str], by_hand: str) -> str:
    """The exact command that installs these, or words where no package is known here."""
    if not packages:
        return f"# {by_hand}"
    manager = package_manager()
    if manager == "brew":
        return f"brew install {' '.join(packages)}"
    sudo = "" if os.geteuid() == 0 else "sudo "
    command = f"{sudo}{manager} install -y {' '.join(packages)}"
    lists_are_empty = manager == "apt-get" and not apt_offers([])
    return f"{sudo}apt-get update && {command}" if lists_are_empty else command


def apt_offers(names: Sequence[str]) -> set[str]:
    """Which of these packages an archive offers, and libc6: the set is empty where apt's lists are, as in a new
    container.
    """
    environ = {**os.environ, "LC_ALL": "C"}
    command = ["apt-cache", "policy", "libc6", *names]
    try:
        done = subprocess.run(command, capture_output=True, text=True, env=environ, timeout=60, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return set()
    package, offered = "", set()
    for line in done.stdout.splitlines():
        if not line.startswith(" "):
            package = line.rstrip(":")
        elif ARCHIVE_LINE.match(line):
            offered.add(package)
    return offered


def unset_command(names: Sequence[str]) -> str:
    """Takes these variables out of the environment."""
    return f"unset {' '.join(names)}"


def pip_command(distribution: str) -> str:
    """Installs a Python package at the version that lightmeter asks for."""
    try:
        wanted = importlib.metadata.requires("lightmeter") or []
    except importlib.metadata.PackageNotFoundError:
        wanted = []
    requirement = next((each for each in wanted if each.startswith(distribution)), distribution)
    return shlex.join([sys.executable, "-m", "pip", "install", requirement])
