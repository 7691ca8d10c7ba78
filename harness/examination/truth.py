"""The truth's side: Mitsuba, Dr.Jit, and the LLVM that it compiles with."""

import re
from collections.abc import Mapping
from pathlib import Path

from lightmeter import device
from lightmeter.examination import children, install
from lightmeter.examination.children import Probe
from lightmeter.examination.finding import Finding

MINIMUM_LLVM = 17
"""Dr.Jit 1.5 uses intrinsics that LLVM 14, 15 and 16 abort on."""

LLVM_VARIABLES = ("DRJIT_LIBLLVM_PATH",)
TRUTH_PROBE = """
import json

def tell(**facts):
    print(json.dumps(facts), flush=True)

import drjit
tell(drjit=drjit.__version__)
import mitsuba
tell(mitsuba=mitsuba.__version__)
cuda = bool(drjit.has_backend(drjit.JitBackend.CUDA))
tell(cuda=cuda)
llvm = bool(drjit.has_backend(drjit.JitBackend.LLVM))
if llvm:
    tell(llvm=".".join(map(str, drjit.detail.llvm_version())))
    try:
        mapped = [line.split()[-1] for line in open("/proc/self/maps") if "libLLVM" in line]
    except OSError:
        mapped = []
    tell(llvm_path=mapped[0] if mapped else None)
variant = "cuda_ad_rgb" if cuda else "llvm_ad_rgb" if llvm else None
tell(variant=variant)
if variant:
    mitsuba.set_variant(variant)
    smaller = drjit.minimum(drjit.arange(mitsuba.Float, 3), 1)
    tell(sum=float(drjit.sum(smaller)[0]))
"""
"""Compiles and runs a kernel with `minimum` in it: the instruction that an LLVM too old aborts on."""

APT_LLVM_KNOWN = (19, 20, 18, 17, 21, 22, 23)
"""LLVM versions in the order they are preferred: those that were tried first."""

APT_LLVM_DEFAULT = {"24.04": "libllvm18"}
"""By Ubuntu's release, where apt's lists are empty and cannot be asked; Debian 12 and 13 have `libllvm19`."""

LIBRARY_PACKAGES = {
    ("libatomic.so.1", "apt-get"): "libatomic1",
    ("libatomic.so.1", "dnf"): "libatomic",
}
"""Which package holds a library that a Python package links and does not bring along. Dr.Jit's wheel links
libatomic, which is there wherever a compiler is installed, and not on a bare system."""

LLVM_PLACES = ("usr/lib/*-linux-gnu/libLLVM*", "usr/lib64/libLLVM*", "usr/lib/llvm*/lib/libLLVM*", "usr/lib/libLLVM*")
LLVM_BY_HAND = f"install LLVM {MINIMUM_LLVM} or newer, and set DRJIT_LIBLLVM_PATH to its libLLVM"


def examine_truth(environ: Mapping[str, str]) -> list[Finding]:
    """Mitsuba with its variant, Dr.Jit, and the LLVM that Dr.Jit compiles with."""
    probe = children.run_probe(TRUTH_PROBE, environ)
    facts = probe.facts
    drjit = _python_package("Dr.Jit", "drjit", probe)
    if not drjit.ok:
        return [drjit, _llvm_on_disk()]
    mitsuba = _python_package("Mitsuba", "mitsuba", probe)
    if not mitsuba.ok:
        return [drjit, mitsuba]
    packages = [drjit, mitsuba]
    variant = facts.get("variant") or "none"
    compiled = not probe.error and facts.get("sum") == 2.0
    if facts.get("cuda") and not compiled:
        note = probe.error or "a kernel gave a wrong sum"
        return [*packages, Finding("variant", variant, False, note, "nvidia-smi  # and update the driver it names")]
    note = "" if compiled else "no CUDA device answers, and no LLVM that works"
    return [*packages, Finding("variant", variant, compiled, note), examine_llvm(probe, environ)]


def examine_llvm(probe: Probe, environ: Mapping[str, str]) -> Finding:
    """The LLVM that Dr.Jit found, from what the truth's probe told before it ended."""
    facts = probe.facts
    value = f"{facts['llvm']}, {facts.get('llvm_path') or 'path unknown'}" if "llvm" in facts else "not found"
    if facts.get("cuda"):
        return Finding("LLVM", value, note="not needed: the CUDA variant is used")
    problem = _llvm_problem(probe)
    if not problem:
        return Finding("LLVM", value)
    culprits = children.culprits(TRUTH_PROBE, LLVM_VARIABLES, environ, lambda retry: not _llvm_problem(retry))
    if culprits:
        path = environ[culprits[0]]
        return Finding(
            "LLVM", value, False, f"{problem}; {culprits[0]} is set to {path}", install.unset_command(culprits)
        )
    packages = _llvm_packages()
    return Finding("LLVM", value, False, problem, install.system_packages(packages, LLVM_BY_HAND), packages)


def _llvm_problem(probe: Probe) -> str:
    """Why this LLVM does not do; empty where it does."""
    if "llvm" not in probe.facts:
        return probe.error or f"Dr.Jit needs LLVM {MINIMUM_LLVM} or newer"
    if probe.error:
        major = int(probe.facts["llvm"].split(".")[0])
        old = f"Dr.Jit needs LLVM {MINIMUM_LLVM} or newer; " if major < MINIMUM_LLVM else ""
        return f"{old}compiling with this one, {probe.error}"
    if probe.facts.get("sum") != 2.0:
        return f"a kernel compiled with it gave {probe.facts.get('sum')} where 2 is right"
    return ""


def _llvm_on_disk() -> Finding:
    """What can be said of LLVM while Dr.Jit does not load: whether one new enough lies where Dr.Jit looks.

    Without it, a user would be told of the second package that lacks only after having installed the first.
    """
    paths = sorted(path for pattern in LLVM_PLACES for path in Path("/").glob(pattern))
    newest = max(((_llvm_major(path.name), str(path)) for path in paths), default=(0, ""))
    if newest[0] >= MINIMUM_LLVM:
        return Finding("LLVM", newest[1], note="not tried, since Dr.Jit does not load")
    packages = _llvm_packages()
    problem = f"Dr.Jit needs LLVM {MINIMUM_LLVM} or newer"
    return Finding("LLVM", "not found", False, problem, install.system_packages(packages, LLVM_BY_HAND), packages)


def _llvm_major(name: str) -> int:
    """19 for libLLVM.so.19.1 and libLLVM-19.so; 0 where the name does not tell."""
    found = re.search(r"libLLVM(?:-|\.so\.)(\d+)", name)
    return int(found[1]) if found else 0


def _python_package(name: str, module: str, probe: Probe) -> Finding:
    """Whether one of the truth's Python packages could be imported; else what it lacks, or itself."""
    if module in probe.facts:
        return Finding(name, probe.facts[module])
    library = children.MISSING_LIBRARY.search(probe.error)
    if library is None:
        return Finding(name, "not importable", False, probe.error, install.pip_command(module))
    known = LIBRARY_PACKAGES.get((library[1], install.package_manager()))
    packages = (known,) if known else ()
    remedy = install.system_packages(packages, f"install the library {library[1]}")
    return Finding(name, "not importable", False, probe.error, remedy, packages)


def _llvm_packages() -> tuple[str, ...]:
    """The package of an LLVM that is new enough, as this system calls it; none where none is known."""
    manager = install.package_manager()
    if manager == "apt-get":
        name = _apt_llvm()
        return (name,) if name else ()
    return {"dnf": ("llvm-libs",), "brew": ("llvm",)}.get(manager, ())


def _apt_llvm() -> str:
    """The LLVM package that this release of Debian or Ubuntu offers; empty where it has none new enough."""
    names = [f"libllvm{version}" for version in APT_LLVM_KNOWN]
    offered = install.apt_offers(names)
    if not offered:
        return APT_LLVM_DEFAULT.get(device.os_release().get("VERSION_ID", ""), names[0])
    return next((name for name in names if name in offered), "")
