"""What this machine is: the facts that make two results comparable, or explain why they are not.

Nothing here imports a renderer. Versions are read from the installed packages' metadata; the variant and the
LLVM version are read from Mitsuba and Dr.Jit only where this process has already loaded them, so that asking
for a fingerprint never costs the second it takes to load them.
"""

import hashlib
import importlib.metadata
import os
import platform
import subprocess
import sys
from pathlib import Path

CPUINFO = Path("/proc/cpuinfo")

SOFTWARE_RASTERISERS = ("llvmpipe", "softpipe", "swiftshader", "software rasterizer", "swr ")

Fingerprint = dict[str, str | int | bool | None]


def fingerprint(gl_renderer: str | None = None, gl_version: str | None = None) -> Fingerprint:
    """The device, as results.json records it.

    The two GL strings come from the context that made the frame; a value that this run did not use is None.
    """
    return {
        "cpu": cpu_model(),
        "cores": cores(),
        "gl_renderer": gl_renderer,
        "gl_version": gl_version,
        "gl_software": None if gl_renderer is None else is_software(gl_renderer),
        "mitsuba": installed_version("mitsuba"),
        "drjit": installed_version("drjit"),
        "variant": loaded_variant(),
        "llvm": loaded_llvm(),
        "lightmeter": installed_version("lightmeter"),
        "python": platform.python_version(),
        "os": operating_system(),
    }


def device_digest(found: Fingerprint) -> str:
    """Eight hex digits that machines share when their times may be compared: processor, cores, GL renderer, driver."""
    told = [str(found[key]) for key in ("cpu", "cores", "gl_renderer", "gl_version")]
    return hashlib.sha256("\n".join(told).encode()).hexdigest()[:8]


def is_software(gl_renderer: str) -> bool:
    """Whether this GL renderer draws on the CPU, where timer queries do not mean what they say."""
    name = gl_renderer.lower()
    return any(known in name for known in SOFTWARE_RASTERISERS)


def installed_version(distribution: str) -> str | None:
    """Version of an installed distribution, read without importing it."""
    try:
        return importlib.metadata.version(distribution)
    except importlib.metadata.PackageNotFoundError:
        return None


def cores() -> int:
    """Cores this process may run on: what counts in a container or under taskset, not what the board has."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def cpu_model() -> str:
    """The processor's marketing name where the system tells it, else its architecture."""
    return _cpu_from_cpuinfo() or _cpu_from_sysctl() or platform.processor() or platform.machine()


def operating_system() -> str:
    """Distribution (or system) and kernel architecture, in a line."""
    return f"{os_release().get('PRETTY_NAME') or platform.system()} ({platform.machine()})"


def os_release() -> dict[str, str]:
    """The fields of /etc/os-release; empty where there is none."""
    try:
        return platform.freedesktop_os_release()
    except OSError:
        return {}


def loaded_variant() -> str | None:
    """Mitsuba's variant in this process; None where it has not been loaded."""
    mitsuba = sys.modules.get("mitsuba")
    return mitsuba.variant() if mitsuba is not None else None


def loaded_llvm() -> str | None:
    """Version of the LLVM that Dr.Jit compiles with in this process; None where it has loaded none.

    Mesa's llvmpipe may have another LLVM in the same process, so Dr.Jit itself is asked. Asking it before it has
    loaded an LLVM would load one: the variant says whether it has.
    """
    drjit = sys.modules.get("drjit")
    if drjit is None or not (loaded_variant() or "").startswith("llvm"):
        return None
    version = drjit.detail.llvm_version()
    return ".".join(map(str, version)) if version[0] > 0 else None


def _cpu_from_cpuinfo() -> str | None:
    try:
        lines = CPUINFO.read_text(errors="replace").splitlines()
    except OSError:
        return None
    fields = (line.partition(":") for line in lines)
    return next((value.strip() for key, _, value in fields if key.strip() == "model name"), None)


def _cpu_from_sysctl() -> str | None:
    """macOS has no /proc."""
    if sys.platform != "darwin":
        return None
    command = ["/usr/sbin/sysctl", "-n", "machdep.cpu.brand_string"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.stdout.strip() or None
