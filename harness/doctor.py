"""`lightmeter doctor`: what this machine has, and the exact command for what it lacks.

Both renderers are tried in child processes, because both can take the process down with them: a GL driver may
crash, and Dr.Jit aborts when the LLVM it found cannot compile for it (14, 15 and 16 cannot). A child reports
each fact as it learns it, so that what it knew before it died is not lost.

The same examination tells the set-up script what to install: `python -m lightmeter.doctor --packages`.
"""

import importlib.metadata
import json as jsonlib
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path

from lightmeter import device

TIMEOUT = 120.0
"""Seconds for one probe. A cold import from a slow disk takes tens of seconds; a hang has no end."""

MINIMUM_GL = 410
"""The shaders are GLSL 4.10, the newest that macOS has."""

MINIMUM_LLVM = 17
"""Dr.Jit 1.5 uses intrinsics that LLVM 14, 15 and 16 abort on."""

GL_VARIABLES = (
    "__EGL_VENDOR_LIBRARY_DIRS",
    "__EGL_VENDOR_LIBRARY_FILENAMES",
    "EGL_PLATFORM",
    "GALLIUM_DRIVER",
    "GLCONTEXT_DEVICE_INDEX",
    "GLCONTEXT_GLVERSION",
    "GLCONTEXT_LINUX_LIBEGL",
    "GLCONTEXT_LINUX_LIBGL",
    "LIBGL_DRIVERS_PATH",
    "MESA_GL_VERSION_OVERRIDE",
    "MESA_LOADER_DRIVER_OVERRIDE",
)
"""Environment variables that choose a GL driver, and so can choose a wrong one."""

LLVM_VARIABLES = ("DRJIT_LIBLLVM_PATH",)

GL_PROBE = """
import json, sys

def tell(**facts):
    print(json.dumps(facts), flush=True)

import moderngl
tell(moderngl=moderngl.__version__)
backend = {"backend": "egl"} if sys.platform.startswith("linux") else {}
context = moderngl.create_context(standalone=True, **backend)
tell(renderer=context.info["GL_RENDERER"], version=context.info["GL_VERSION"], code=context.version_code)
target = context.framebuffer([context.texture((1, 1), 4, dtype="f4")])
target.clear(0.25, 0.5, 0.75, 1.0)
tell(pixel=[round(x, 3) for x in memoryview(target.read(components=4, dtype="f4")).cast("f")])
"""
"""Makes a context as the renderer does, and reads back a pixel: a driver may open and not draw."""

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

APT_GL = ("libegl1", "libgl1", "libgl1-mesa-dri")
DNF_GL = ("mesa-libEGL", "mesa-libGL", "mesa-dri-drivers")
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

MISSING_LIBRARY = re.compile(r"(\S+\.so[\w.]*): cannot open shared object file.*")
"""The dynamic loader's words."""

ARCHIVE_LINE = re.compile(r"^ +\d+ (?!/var/lib/dpkg/status)")
"""A line of `apt-cache policy` that names where a version comes from, other than from being installed."""


@dataclass(frozen=True)
class Finding:
    """One thing that lightmeter needs: what was found, and, where it does not do, what to run."""

    name: str
    value: str
    ok: bool = True
    note: str = ""
    remedy: str = ""
    packages: tuple[str, ...] = ()
    """System packages that `remedy` installs, by the names this distribution gives them."""


@dataclass(frozen=True)
class Probe:
    """What a child process told, and how it ended: `error` is empty where it ended well."""

    facts: dict = field(default_factory=dict)
    error: str = ""


def examine(environ: Mapping[str, str] | None = None) -> list[Finding]:
    """Everything lightmeter needs on this machine, in the order it is shown."""
    environ = os.environ if environ is None else environ
    processor = Finding("CPU", f"{device.cpu_model()}, {device.cores()} cores")
    return [_python(), processor, examine_gl(environ), *examine_truth(environ)]


def run(json: bool = False) -> int:
    """Print the examination; 0 where nothing lacks, else 1."""
    findings = examine()
    ok = all(finding.ok for finding in findings)
    if json:
        document = {"ok": ok, "findings": [asdict(finding) for finding in findings]}
        print(jsonlib.dumps(document, indent=2, ensure_ascii=False))
    elif sys.stdout.isatty():
        _print_table(findings)
    else:
        print(as_text(findings))
    return 0 if ok else 1


def as_text(findings: Sequence[Finding]) -> str:
    """The findings as plain lines, which wrap nowhere, so that a command can be copied from a log."""
    width = max(len(finding.name) for finding in findings)
    lines = []
    for finding in findings:
        lines.append(f"{finding.name:<{width}}  {'ok  ' if finding.ok else 'LACK'}  {finding.value}")
        if finding.note:
            lines.append(" " * (width + 8) + finding.note)
    return "\n".join([*lines, "", *_closing(findings)])


def missing_packages(findings: Sequence[Finding]) -> list[str]:
    """System packages to install, each once."""
    return list(dict.fromkeys(name for finding in findings if not finding.ok for name in finding.packages))


def remedies(findings: Sequence[Finding]) -> list[str]:
    """The commands to run: all system packages in one, then each other command once."""
    packages = missing_packages(findings)
    together = [_install(packages, "")] if packages else []
    others = [finding.remedy for finding in findings if finding.remedy and not finding.packages]
    return together + list(dict.fromkeys(others))


# --- the real-time side -------------------------------------------------------------------------------------


def examine_gl(environ: Mapping[str, str]) -> Finding:
    """The GL driver the real-time renderer will get."""
    probe = run_probe(GL_PROBE, environ)
    problem = _gl_problem(probe)
    value = _gl_value(probe.facts)
    if not problem:
        return Finding("OpenGL", value, note=_gl_note(probe.facts))
    if "moderngl" not in probe.facts:
        return Finding("OpenGL", value, False, problem, _pip_command("moderngl"))
    culprits = _culprits(GL_PROBE, GL_VARIABLES, environ, lambda retry: not _gl_problem(retry))
    if culprits:
        return Finding("OpenGL", value, False, f"{problem}; it works without {', '.join(culprits)}", _unset(culprits))
    packages = _gl_packages()
    return Finding("OpenGL", value, False, problem, _install(packages, GL_BY_HAND), packages)


def _gl_problem(probe: Probe) -> str:
    """Why the driver does not do; empty where it does."""
    if probe.error:
        return probe.error
    if probe.facts["code"] < MINIMUM_GL:
        return f"the shaders need OpenGL {MINIMUM_GL // 100}.{MINIMUM_GL // 10 % 10}"
    if probe.facts["pixel"] != [0.25, 0.5, 0.75, 1.0]:
        return f"a cleared pixel was read back as {probe.facts['pixel']}, not as (0.25, 0.5, 0.75, 1)"
    return ""


def _gl_value(facts: dict) -> str:
    return f"{facts['renderer']}, OpenGL {facts['version']}" if "renderer" in facts else "no context through EGL"


def _gl_note(facts: dict) -> str:
    digest = device.device_digest(device.fingerprint(facts["renderer"], facts["version"]))
    note = f"limits on time_ms call this device {digest}"
    if device.is_software(facts["renderer"]):
        note += "; software rasteriser: frame times are the CPU's, taken as wall time"
    return note


# --- the truth's side ---------------------------------------------------------------------------------------


def examine_truth(environ: Mapping[str, str]) -> list[Finding]:
    """Mitsuba with its variant, Dr.Jit, and the LLVM that Dr.Jit compiles with."""
    probe = run_probe(TRUTH_PROBE, environ)
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
    culprits = _culprits(TRUTH_PROBE, LLVM_VARIABLES, environ, lambda retry: not _llvm_problem(retry))
    if culprits:
        path = environ[culprits[0]]
        return Finding("LLVM", value, False, f"{problem}; {culprits[0]} is set to {path}", _unset(culprits))
    packages = _llvm_packages()
    return Finding("LLVM", value, False, problem, _install(packages, LLVM_BY_HAND), packages)


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
    return Finding("LLVM", "not found", False, problem, _install(packages, LLVM_BY_HAND), packages)


def _llvm_major(name: str) -> int:
    """19 for libLLVM.so.19.1 and libLLVM-19.so; 0 where the name does not tell."""
    found = re.search(r"libLLVM(?:-|\.so\.)(\d+)", name)
    return int(found[1]) if found else 0


def _python_package(name: str, module: str, probe: Probe) -> Finding:
    """Whether one of the truth's Python packages could be imported; else what it lacks, or itself."""
    if module in probe.facts:
        return Finding(name, probe.facts[module])
    library = MISSING_LIBRARY.search(probe.error)
    if library is None:
        return Finding(name, "not importable", False, probe.error, _pip_command(module))
    known = LIBRARY_PACKAGES.get((library[1], _manager()))
    packages = (known,) if known else ()
    remedy = _install(packages, f"install the library {library[1]}")
    return Finding(name, "not importable", False, probe.error, remedy, packages)


def _python() -> Finding:
    version = ".".join(map(str, sys.version_info[:3]))
    return Finding("Python", f"{version}, {sys.executable}, {device.operating_system()}")


# --- child processes ----------------------------------------------------------------------------------------


def run_probe(source: str, environ: Mapping[str, str], timeout: float = TIMEOUT) -> Probe:
    """Run Python source in a child process; a line of JSON on its standard output is a fact or several."""
    # -P: a user's own `drjit.py` or `metrics/` in the working directory is not what is being asked about.
    command = [sys.executable, "-P", "-c", source]
    try:
        done = subprocess.run(
            command, stdin=subprocess.DEVNULL, capture_output=True, env=dict(environ), timeout=timeout, check=False
        )
    except subprocess.TimeoutExpired as late:
        return Probe(_facts(late.stdout or b""), f"it gave no answer within {timeout:g} s")
    return Probe(_facts(done.stdout), _ending(done.returncode, done.stderr))


def _facts(output: bytes) -> dict:
    """The facts among a child's lines; a driver may print lines of its own."""
    facts: dict = {}
    for line in output.decode(errors="replace").splitlines():
        if line.startswith("{"):
            try:
                facts |= jsonlib.loads(line)
            except ValueError:  # cut off by the child's death
                continue
    return facts


def _ending(code: int, stderr: bytes) -> str:
    """How a child ended, in words; empty where it ended well."""
    if code == 0:
        return ""
    if code < 0:
        known = {number.value for number in signal.Signals}
        name = signal.Signals(-code).name if -code in known else f"signal {-code}"
        return f"the process was killed by {name}"
    text = stderr.decode(errors="replace")
    # Dr.Jit's own handling of a library it cannot load fails in turn, so the last line is not the reason.
    library = MISSING_LIBRARY.search(text)
    if library:
        return library[0]
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return lines[-1] if lines else f"the process ended with code {code}"


def _culprits(
    source: str, names: Sequence[str], environ: Mapping[str, str], works: Callable[[Probe], bool]
) -> list[str]:
    """The variables among `names` that are set, where the probe works once they are gone."""
    present = [name for name in names if name in environ]
    if not present:
        return []
    without = {name: value for name, value in environ.items() if name not in present}
    return present if works(run_probe(source, without)) else []


# --- remedies -----------------------------------------------------------------------------------------------

GL_BY_HAND = "install your system's EGL and OpenGL driver (Mesa's llvmpipe is enough)"
LLVM_BY_HAND = f"install LLVM {MINIMUM_LLVM} or newer, and set DRJIT_LIBLLVM_PATH to its libLLVM"


def _gl_packages() -> tuple[str, ...]:
    """The GL driver's packages; none on macOS, whose driver is part of the system."""
    return {"apt-get": APT_GL, "dnf": DNF_GL}.get(_manager(), ())


def _llvm_packages() -> tuple[str, ...]:
    manager = _manager()
    if manager == "apt-get":
        name = _apt_llvm()
        return (name,) if name else ()
    return {"dnf": ("llvm-libs",), "brew": ("llvm",)}.get(manager, ())


def _manager() -> str:
    """The package manager of this system, by the name of its command; empty where it is none of those known."""
    return next((name for name in ("apt-get", "dnf", "brew") if shutil.which(name)), "")


def _install(packages: Sequence[str], by_hand: str) -> str:
    """The exact command that installs these, or words where no package is known here."""
    if not packages:
        return f"# {by_hand}"
    manager = _manager()
    if manager == "brew":
        return f"brew install {' '.join(packages)}"
    sudo = "" if os.geteuid() == 0 else "sudo "
    command = f"{sudo}{manager} install -y {' '.join(packages)}"
    lists_are_empty = manager == "apt-get" and not _apt_offers([])
    return f"{sudo}apt-get update && {command}" if lists_are_empty else command


def _apt_llvm() -> str:
    """The LLVM package that this release of Debian or Ubuntu offers; empty where it has none new enough."""
    names = [f"libllvm{version}" for version in APT_LLVM_KNOWN]
    offered = _apt_offers(names)
    if not offered:
        return APT_LLVM_DEFAULT.get(device.os_release().get("VERSION_ID", ""), names[0])
    return next((name for name in names if name in offered), "")


def _apt_offers(names: Sequence[str]) -> set[str]:
    """Which of these packages an archive offers, and libc6: the set is empty where apt's lists are, as in a
    new container."""
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


def _unset(names: Sequence[str]) -> str:
    return f"unset {' '.join(names)}"


def _pip_command(distribution: str) -> str:
    """Installs a Python package at the version that lightmeter asks for."""
    try:
        wanted = importlib.metadata.requires("lightmeter") or []
    except importlib.metadata.PackageNotFoundError:
        wanted = []
    requirement = next((each for each in wanted if each.startswith(distribution)), distribution)
    return shlex.join([sys.executable, "-m", "pip", "install", requirement])


# --- showing ------------------------------------------------------------------------------------------------


def _closing(findings: Sequence[Finding]) -> list[str]:
    """The last lines: nothing lacks, or the commands to run."""
    if all(finding.ok for finding in findings):
        return ["Everything that lightmeter needs is here."]
    return ["To mend it, run:", *(f"  {command}" for command in remedies(findings))]


def _print_table(findings: Sequence[Finding]) -> None:
    """For a person at a terminal. Rich is imported here: no other use of this module needs it."""
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    table = Table(show_header=False, box=None, padding=(0, 1))
    for finding in findings:
        mark = Text("✓", "green") if finding.ok else Text("✗", "bold red")
        table.add_row(mark, Text(finding.name, "bold"), Text(finding.value))
        if finding.note:
            table.add_row("", "", Text(finding.note, "dim" if finding.ok else "yellow"))
    console = Console()
    console.print(table)
    console.print()
    for line in _closing(findings):
        console.print(line, markup=False, highlight=False, soft_wrap=True)


def _main(arguments: Sequence[str]) -> int:
    """`--packages` prints only the system packages that lack, for the set-up script."""
    if list(arguments) == ["--packages"]:
        print(" ".join(missing_packages(examine())))
        return 0
    return run(json="--json" in arguments)


if __name__ == "__main__":
    sys.exit(_main(sys.argv[1:]))
