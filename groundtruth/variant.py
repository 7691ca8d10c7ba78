"""Which Mitsuba variant runs here, chosen once: `cuda_ad_rgb` where a device answers, else `llvm_ad_rgb`.

Importing `lightmeter.groundtruth` imports no Mitsuba. A module that computes with it begins with

    from lightmeter.groundtruth.variant import dr, mi

which sets the variant, or raises `NoRendererError` with the command that mends it.
"""

import ctypes
import glob
import json
import os
import re
import subprocess
import sys
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

LIBRARY_VARIABLE = "DRJIT_LIBLLVM_PATH"
OLDEST_USABLE_LLVM = 17
"""Dr.Jit 1.5 refuses LLVM before 15 and aborts the process with 15 and 16 ("Cannot select fminimum"); 14 likewise."""

_FOLDERS = ("/usr/lib/x86_64-linux-gnu", "/usr/lib/aarch64-linux-gnu", "/usr/lib/wsl/lib")
_REMEDY = (
    "Install LLVM 17 or newer (Debian, Ubuntu: `sudo apt-get install libllvm19`), "
    f"or set {LIBRARY_VARIABLE} to the path of its libLLVM.so"
)


class NoRendererError(RuntimeError):
    """The ground truth cannot be computed on this machine.

    Attributes:
        remedy: what to install or set.
    """

    def __init__(self, what: str, remedy: str = _REMEDY):
        self.remedy = remedy
        super().__init__(f"{what}. {remedy}")


@dataclass(frozen=True)
class Llvm:
    """A shared LLVM library.

    Attributes:
        path: the file Dr.Jit loads.
        major: its version, or None where the file's name does not tell.
    """

    path: str
    major: int | None


def find_llvm() -> Llvm | None:
    """The LLVM library that Dr.Jit 1.5 loads, found by its own rule and without loading it; None: there is none.

    The rule: the path in DRJIT_LIBLLVM_PATH, else `libLLVM.so` where the linker finds it, else the last in order of
    `libLLVM*.so.*` in the system's library folders.
    """
    named = os.environ.get(LIBRARY_VARIABLE)
    if named:
        return Llvm(named, _major(named)) if Path(named).exists() else None
    path = _linker_finds("libLLVM.so")
    if path is None:
        # glob, as Dr.Jit does it: the order of the names decides, and "libLLVM-16" comes before "libLLVM.so.19".
        found = [f for folder in _FOLDERS for f in sorted(glob.glob(f"{folder}/libLLVM*.so.*"))]  # noqa: PTH207
        path = found[-1] if found else None
    return Llvm(path, _major(path)) if path else None


def _linker_finds(name: str) -> str | None:
    """Where the dynamic linker finds `name`; the lookup happens in a child, which may load what it likes."""
    folders = [f for f in os.environ.get("LD_LIBRARY_PATH", "").split(":") if f]
    folders += ["/lib", "/usr/lib", "/usr/local/lib", *_FOLDERS[:2], "/lib64", "/usr/lib64"]
    return next((f"{folder}/{name}" for folder in folders if Path(f"{folder}/{name}").exists()), None)


def _major(path: str) -> int | None:
    """LLVM's major version from the file's name, links followed."""
    for name in (Path(path).resolve().name, Path(path).name):
        match = re.search(r"libLLVM(?:-|\.so\.|\.)(\d+)", name)
        if match:
            return int(match[1])
    return None


@dataclass(frozen=True)
class Probe:
    """What a child process found out about the renderer.

    Attributes:
        works: whether a small kernel ran and was right.
        variant: the Mitsuba variant it ran in.
        llvm: the library and its version, as Dr.Jit reports it.
        message: the last words of the child where it failed.
    """

    works: bool
    variant: str
    llvm: str
    message: str


_CHILD = """
import json, mitsuba
from lightmeter.groundtruth import variant
name = variant.choose()
mitsuba.set_variant(name)
import drjit
value = drjit.minimum(mitsuba.Float([1.0, 3.0]), drjit.opaque(mitsuba.Float, 2.0))
ok = list(value) == [1.0, 2.0]
version = drjit.detail.llvm_version() if name.startswith("llvm") else ""
print(json.dumps({"works": ok, "variant": name, "llvm": version}))
"""


def probe(seconds: float = 60.0) -> Probe:
    """Runs a small kernel in a child process, since an unusable LLVM ends the process that loads it."""
    library = find_llvm()
    path = library.path if library else ""
    try:
        child = subprocess.run(
            [sys.executable, "-c", _CHILD], capture_output=True, text=True, timeout=seconds, check=False
        )
    except subprocess.TimeoutExpired:
        return Probe(False, "", path, f"no answer within {seconds:g} s")
    try:
        said = json.loads(child.stdout.strip().splitlines()[-1])
    except (ValueError, IndexError):
        words = child.stderr.strip().splitlines()
        return Probe(False, "", path, words[-1] if words else f"the process ended with {child.returncode}")
    return Probe(bool(said["works"]), said["variant"], f"{said['llvm']} {path}".strip(), "")


def cuda_answers() -> bool:
    """Whether an NVIDIA driver is there and counts at least one device."""
    try:
        driver = ctypes.CDLL("libcuda.so.1")
        count = ctypes.c_int(0)
        return driver.cuInit(0) == 0 and driver.cuDeviceGetCount(ctypes.byref(count)) == 0 and count.value > 0
    except (OSError, AttributeError):
        return False


def choose() -> str:
    """The variant's name, `LIGHTMETER_VARIANT` if that is set.

    Raises:
        NoRendererError: neither CUDA nor a usable LLVM is there.
    """
    asked = os.environ.get("LIGHTMETER_VARIANT")
    if asked not in (None, "", "cuda_ad_rgb", "llvm_ad_rgb"):
        raise NoRendererError(
            f"LIGHTMETER_VARIANT is {asked!r}, expected cuda_ad_rgb or llvm_ad_rgb", "Unset it, or set one of the two"
        )
    variant = asked or ("cuda_ad_rgb" if cuda_answers() else "llvm_ad_rgb")
    if variant == "llvm_ad_rgb":
        library = find_llvm()
        if library is None:
            named = os.environ.get(LIBRARY_VARIABLE)
            what = f"{LIBRARY_VARIABLE} names {named}, which is not there" if named else "no LLVM library was found"
            raise NoRendererError(what)
        if library.major is not None and library.major < OLDEST_USABLE_LLVM:
            raise NoRendererError(f"Dr.Jit would load LLVM {library.major} ({library.path}), which it cannot use")
    return variant


@cache
def activate() -> str:
    """Sets the variant, once; returns its name.

    Raises:
        NoRendererError: Mitsuba cannot run here.
    """
    variant = choose()
    try:
        import mitsuba
    except ImportError as error:
        raise NoRendererError(
            f"Mitsuba cannot be imported ({error})", "Reinstall it: pip install --force-reinstall mitsuba==3.9.1"
        ) from error
    try:
        mitsuba.set_variant(variant)
    except ImportError as error:  # a file of LLVM's name that is none, or one for another processor
        raise NoRendererError(f"Mitsuba's {variant} does not start ({str(error).partition('!')[0]})") from error
    import drjit

    # Whether Dr.Jit fetches a row at once depends on which of its numbers are still referred to when a kernel is
    # compiled, which is the garbage collector's business: the same work would be compiled anew now and then (0.5 s
    # each time). Single fetches cost about 3 %.
    drjit.set_flag(drjit.JitFlag.PacketOps, False)
    return variant


def __getattr__(name: str) -> Any:
    """`mi` and `dr`: Mitsuba and Dr.Jit, with the variant set."""
    if name == "mi":
        activate()
        import mitsuba

        return mitsuba
    if name == "dr":
        activate()
        import drjit

        return drjit
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
