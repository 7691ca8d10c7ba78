"""Machines that lack a part: one message with a remedy and exit code 2, and what can be done without it is done."""

import errno
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from .small_images import exr, noise

LINUX = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="EGL and these variables are Linux's")
NO_GL = {"__EGL_VENDOR_LIBRARY_DIRS": "/nonexistent"}
CPU = {"LIGHTMETER_VARIANT": "llvm_ad_rgb"}


def lightmeter(folder: Path, *words: str, **variables: str) -> subprocess.CompletedProcess[str]:
    """A command with these environment variables, in a process and with a store of its own."""
    environment = {**os.environ, "LIGHTMETER_STORE": str(folder / "store"), **variables}
    command = [sys.executable, "-m", "lightmeter", *words, "--size", "8x8", "--spp", "8", "--json", "-o", "out"]
    return subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, timeout=120, check=False
    )


def refusal(ran: subprocess.CompletedProcess[str]) -> str:
    """The one message of a command that ended with exit code 2."""
    assert ran.returncode == 2, ran.stderr
    assert ran.stdout == ""
    lines = [line for line in ran.stderr.splitlines() if line.startswith("lightmeter: ")]
    assert len(lines) == 1, ran.stderr
    assert "Traceback" not in ran.stderr
    return lines[0].removeprefix("lightmeter: error: ")


@LINUX
def test_no_opengl(tmp_path):
    message = refusal(lightmeter(tmp_path, "compare", "posts", **NO_GL))
    assert "no OpenGL 4.1 context" in message
    assert "lightmeter doctor" in message
    truth = lightmeter(tmp_path, "reference", "posts", **NO_GL)
    assert truth.returncode == 0, truth.stderr
    assert json.loads(truth.stdout)["batches"] == 8


@LINUX
def test_no_llvm(tmp_path):
    message = refusal(lightmeter(tmp_path, "compare", "posts", DRJIT_LIBLLVM_PATH="/nonexistent/libLLVM.so", **CPU))
    assert "/nonexistent/libLLVM.so, which is not there" in message
    assert "Install LLVM" in message


@LINUX
def test_a_file_that_is_no_llvm(tmp_path):
    (tmp_path / "libLLVM.so.19").write_text("no library")
    path = str(tmp_path / "libLLVM.so.19")
    message = refusal(lightmeter(tmp_path, "reference", "posts", DRJIT_LIBLLVM_PATH=path, **CPU))
    assert "llvm_ad_rgb does not start" in message
    assert "Install LLVM" in message


def test_no_place_for_the_store(tmp_path):
    (tmp_path / "file").write_text("in the way")
    ran = lightmeter(tmp_path, "reference", "posts", LIGHTMETER_STORE=str(tmp_path / "file" / "store"))
    assert ran.returncode == 0
    assert json.loads(ran.stdout)["batches"] == 8
    lines = ran.stderr.splitlines()
    assert len(lines) == 1, ran.stderr
    assert "cannot be written: Not a directory" in lines[0]
    assert "LIGHTMETER_STORE" in lines[0]


def test_no_place_for_the_output(tmp_path):
    (tmp_path / "out").write_text("in the way")
    message = refusal(lightmeter(tmp_path, "reference", "posts"))
    assert "out" in message


def test_a_full_disk_under_a_report_is_named(refused, tmp_path, monkeypatch):
    exr(tmp_path / "a.exr", noise())
    full = OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    def fail(*_words, **_options):
        raise full

    monkeypatch.setattr(Path, "write_text", fail)
    said = refused("diff", "a.exr", "a.exr", "-o", "out")
    assert said == "out/results.json: cannot be written (No space left on device)"
