"""The real-time side: the GL driver."""

from collections.abc import Mapping

from lightmeter import device
from lightmeter.examination import children, install
from lightmeter.examination.children import Probe
from lightmeter.examination.finding import Finding

MINIMUM_GL = 410
"""The shaders are GLSL 4.10, the newest that macOS has."""

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

APT_GL = ("libegl1", "libgl1", "libgl1-mesa-dri")
DNF_GL = ("mesa-libEGL", "mesa-libGL", "mesa-dri-drivers")
GL_BY_HAND = "install your system's EGL and OpenGL driver (Mesa's llvmpipe is enough)"


def examine_gl(environ: Mapping[str, str]) -> Finding:
    """The GL driver the real-time renderer will get."""
    probe = children.run_probe(GL_PROBE, environ)
    problem = _gl_problem(probe)
    value = _gl_value(probe.facts)
    if not problem:
        return Finding("OpenGL", value, note=_gl_note(probe.facts))
    if "moderngl" not in probe.facts:
        return Finding("OpenGL", value, False, problem, install.pip_command("moderngl"))
    culprits = children.culprits(GL_PROBE, GL_VARIABLES, environ, lambda retry: not _gl_problem(retry))
    if culprits:
        return Finding(
            "OpenGL",
            value,
            False,
            f"{problem}; it works without {', '.join(culprits)}",
            install.unset_command(culprits),
        )
    packages = _gl_packages()
    return Finding("OpenGL", value, False, problem, install.system_packages(packages, GL_BY_HAND), packages)


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


def _gl_packages() -> tuple[str, ...]:
    """The GL driver's packages; none on macOS, whose driver is part of the system."""
    return {"apt-get": APT_GL, "dnf": DNF_GL}.get(install.package_manager(), ())
