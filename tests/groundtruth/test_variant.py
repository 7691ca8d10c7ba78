"""Choosing Mitsuba's variant, and an LLVM that would end the process."""

import subprocess
import sys

import pytest

from lightmeter.groundtruth import variant
from lightmeter.groundtruth.variant import NoRendererError


@pytest.fixture
def no_cuda(monkeypatch):
    monkeypatch.setattr(variant, "cuda_answers", lambda: False)
    monkeypatch.delenv("LIGHTMETER_VARIANT", raising=False)


@pytest.mark.parametrize("major", [14, 15, 16])
def test_an_llvm_that_drjit_cannot_use_is_refused_before_it_is_loaded(monkeypatch, tmp_path, no_cuda, major):
    library = tmp_path / f"libLLVM-{major}.so.1"
    library.touch()
    monkeypatch.setenv("DRJIT_LIBLLVM_PATH", str(library))
    with pytest.raises(NoRendererError, match=rf"LLVM {major}.*apt-get install libllvm19"):
        variant.choose()


@pytest.mark.parametrize(("name", "major"), [("libLLVM.so.19.1", 19), ("libLLVM-17.so.1", 17), ("libLLVM.so", None)])
def test_a_usable_or_unknown_llvm_is_taken(monkeypatch, tmp_path, no_cuda, name, major):
    (tmp_path / name).touch()
    monkeypatch.setenv("DRJIT_LIBLLVM_PATH", str(tmp_path / name))
    assert variant.find_llvm().major == major
    assert variant.choose() == "llvm_ad_rgb"


def test_a_link_is_followed_to_the_version(monkeypatch, tmp_path, no_cuda):
    (tmp_path / "libLLVM-15.so.1").touch()
    (tmp_path / "libLLVM.so").symlink_to(tmp_path / "libLLVM-15.so.1")
    monkeypatch.setenv("DRJIT_LIBLLVM_PATH", str(tmp_path / "libLLVM.so"))
    assert variant.find_llvm().major == 15


def test_no_llvm_at_all(monkeypatch, tmp_path, no_cuda):
    monkeypatch.setenv("DRJIT_LIBLLVM_PATH", str(tmp_path / "gone.so"))
    with pytest.raises(NoRendererError, match="which is not there") as caught:
        variant.choose()
    assert "libllvm19" in caught.value.remedy
    monkeypatch.delenv("DRJIT_LIBLLVM_PATH")
    monkeypatch.setattr(variant, "_linker_finds", lambda name: None)
    monkeypatch.setattr(variant, "_FOLDERS", (str(tmp_path),))
    with pytest.raises(NoRendererError, match="no LLVM library was found"):
        variant.choose()
    for name in ("libLLVM-16.so.1", "libLLVM.so.19.1", "libLLVM-14.so.1"):
        (tmp_path / name).touch()
    assert variant.find_llvm().major == 19


def test_cuda_comes_first_and_a_wrong_wish_is_refused(monkeypatch):
    monkeypatch.delenv("LIGHTMETER_VARIANT", raising=False)
    monkeypatch.setattr(variant, "cuda_answers", lambda: True)
    assert variant.choose() == "cuda_ad_rgb"
    monkeypatch.setenv("LIGHTMETER_VARIANT", "scalar_rgb")
    with pytest.raises(NoRendererError, match="scalar_rgb"):
        variant.choose()


def test_the_probe_runs_a_kernel_in_a_child():
    found = variant.probe()
    assert found.works, found.message
    assert found.variant == variant.choose()


def test_importing_the_package_and_the_store_imports_no_mitsuba():
    code = (
        "import sys, lightmeter.groundtruth.batches, lightmeter.groundtruth.folder, lightmeter.groundtruth.recall\n"
        "import lightmeter.groundtruth.oracles.tone, lightmeter.groundtruth.oracles.coverage\n"
        "print([m for m in sys.modules if m.split('.')[0] in ('mitsuba', 'drjit', 'colour', 'OpenEXR')])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
