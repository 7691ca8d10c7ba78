"""`lightmeter doctor` finds what lacks, names the command that mends it, and survives what it examines."""

import json
import os
import sys
from pathlib import Path

import pytest

from lightmeter import device, doctor
from lightmeter.examination import children, install
from lightmeter.examination.children import Probe, run_probe
from lightmeter.examination.finding import Finding
from lightmeter.examination.opengl import GL_PROBE, examine_gl
from lightmeter.examination.truth import MINIMUM_LLVM, TRUTH_PROBE, examine_truth

OLD_LLVMS = sorted({str(path.resolve()) for path in Path("/usr/lib").glob("*-linux-gnu/libLLVM-1[456].*so*")})

WORKS_GL = Probe(
    {"moderngl": "5", "renderer": "llvmpipe", "version": "4.5", "code": 450, "pixel": [0.25, 0.5, 0.75, 1.0]}
)
WORKS_TRUTH = Probe(
    {
        "drjit": "1.5.0",
        "mitsuba": "3.9.1",
        "cuda": False,
        "llvm": "19.1.7",
        "llvm_path": "/usr/lib/libLLVM.so.19.1",
        "variant": "llvm_ad_rgb",
        "sum": 2.0,
    }
)


def environment(**changes: str) -> dict[str, str]:
    return {**os.environ, **changes}


def examine_truth_of_the_cpu(**changes: str) -> list[Finding]:
    """The truth's findings with these variables; skipped where a CUDA device makes LLVM superfluous."""
    findings = examine_truth(environment(**changes))
    if any(finding.value == "cuda_ad_rgb" for finding in findings):
        pytest.skip("the CUDA variant is used here")
    return findings


def by_name(findings: list[Finding]) -> dict[str, Finding]:
    return {finding.name: finding for finding in findings}


def pretend(monkeypatch, gl: Probe = WORKS_GL, truth: Probe = WORKS_TRUTH) -> None:
    """Answer for the child processes."""
    answers = {GL_PROBE: gl, TRUTH_PROBE: truth}
    monkeypatch.setattr(children, "run_probe", lambda source, environ, timeout=0.0: answers[source])


def with_apt(monkeypatch, offered: set[str]) -> None:
    """A Debian whose archive offers these packages."""
    monkeypatch.setattr(install, "package_manager", lambda: "apt-get")
    monkeypatch.setattr(install, "apt_offers", lambda names: offered)
    monkeypatch.setattr(install.os, "geteuid", lambda: 1000)
    monkeypatch.setattr("lightmeter.examination.truth.LLVM_PLACES", ())


# --- this machine -------------------------------------------------------------------------------------------


def test_the_machine_of_the_tests_has_everything():
    findings = doctor.examine()
    assert [finding for finding in findings if not finding.ok] == []
    assert list(by_name(findings)) == ["Python", "CPU", "OpenGL", "Dr.Jit", "Mitsuba", "variant", "LLVM"]


def test_the_llvm_in_use_is_named_with_its_path():
    found = by_name(examine_truth_of_the_cpu())
    assert Path(found["LLVM"].value.split(", ")[1]).exists()


@pytest.mark.skipif(not OLD_LLVMS, reason="no LLVM that is too old on this machine")
@pytest.mark.parametrize("path", OLD_LLVMS)
def test_an_llvm_too_old_is_a_finding_and_not_a_crash(path):
    found = by_name(examine_truth_of_the_cpu(DRJIT_LIBLLVM_PATH=path))
    assert not found["LLVM"].ok
    assert "LLVM 17 or newer" in found["LLVM"].note
    assert path in found["LLVM"].note
    assert found["LLVM"].remedy == "unset DRJIT_LIBLLVM_PATH"
    assert not found["variant"].ok
    assert found["Mitsuba"].ok


def test_an_llvm_path_that_leads_nowhere():
    found = by_name(examine_truth_of_the_cpu(DRJIT_LIBLLVM_PATH="/nonexistent/libLLVM.so"))
    assert not found["LLVM"].ok
    assert "/nonexistent/libLLVM.so" in found["LLVM"].note
    assert found["LLVM"].remedy == "unset DRJIT_LIBLLVM_PATH"


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="EGL is Linux's")
@pytest.mark.parametrize(
    "variables",
    [{"__EGL_VENDOR_LIBRARY_DIRS": "/nonexistent"}, {"GALLIUM_DRIVER": "nonsense", "LIBGL_DRIVERS_PATH": "/none"}],
)
def test_a_gl_driver_that_the_environment_hides(variables):
    found = examine_gl(environment(**variables))
    if found.ok:
        pytest.skip("this machine's driver does not heed these variables")
    assert all(name in found.note for name in variables)
    assert found.remedy.startswith("unset ")
    assert set(found.remedy.split()[1:]) >= set(variables)


# --- child processes ----------------------------------------------------------------------------------------


def test_what_a_child_told_before_it_died_is_kept():
    probe = run_probe('print(\'{"llvm": "15.0.6"}\', flush=True)\nimport os; os.abort()', os.environ)
    assert probe.facts == {"llvm": "15.0.6"}
    assert "SIGABRT" in probe.error


def test_a_child_that_hangs_is_ended():
    probe = run_probe("print('{\"a\": 1}', flush=True)\nimport time; time.sleep(60)", os.environ, 1.0)
    assert probe.facts == {"a": 1}
    assert "within 1 s" in probe.error


def test_a_library_that_lacks_is_named_whatever_the_last_line_says():
    source = "import sys; print('ImportError: libatomic.so.1: cannot open shared object file: No such file'"
    probe = run_probe(source + ", file=sys.stderr); nonsense", os.environ)
    assert probe.error.startswith("libatomic.so.1: cannot open")


def test_lines_that_are_no_facts_are_passed_over():
    probe = run_probe("print('libEGL warning: {'); print('{oh'); print('{\"a\": 1}')", os.environ)
    assert probe == Probe({"a": 1}, "")


def test_files_of_the_working_directory_are_not_imported(tmp_path, monkeypatch):
    (tmp_path / "moderngl.py").write_text("raise SystemExit('the wrong one')")
    monkeypatch.chdir(tmp_path)
    assert "wrong one" not in run_probe("import moderngl", os.environ).error


# --- remedies -----------------------------------------------------------------------------------------------


def test_a_bare_debian_is_told_everything_at_once(monkeypatch):
    loader = "libatomic.so.1: cannot open shared object file: No such file or directory"
    gl = Probe({"moderngl": "5"}, "Exception: libGL.so not loaded")
    pretend(monkeypatch, gl, Probe({}, loader))
    with_apt(monkeypatch, {"libc6", "libllvm16", "libllvm19"})
    assert doctor.remedies(doctor.examine({})) == [
        "sudo apt-get install -y libegl1 libgl1 libgl1-mesa-dri libatomic1 libllvm19"
    ]


def test_the_newest_llvm_that_was_tried_is_chosen(monkeypatch):
    pretend(monkeypatch, truth=Probe({"drjit": "1", "mitsuba": "3", "cuda": False, "variant": None}))
    with_apt(monkeypatch, {"libc6", "libllvm15", "libllvm18", "libllvm22"})
    assert by_name(doctor.examine({}))["LLVM"].packages == ("libllvm18",)


def test_empty_package_lists_are_filled_first(monkeypatch):
    pretend(monkeypatch, truth=Probe({"drjit": "1", "mitsuba": "3", "cuda": False, "variant": None}))
    with_apt(monkeypatch, set())
    monkeypatch.setattr(device, "os_release", lambda: {"ID": "ubuntu", "VERSION_ID": "24.04"})
    remedy = by_name(doctor.examine({}))["LLVM"].remedy
    assert remedy == "sudo apt-get update && sudo apt-get install -y libllvm18"


def test_a_release_without_a_new_llvm_gets_words_and_no_command(monkeypatch):
    pretend(monkeypatch, truth=Probe({"drjit": "1", "mitsuba": "3", "cuda": False, "variant": None}))
    with_apt(monkeypatch, {"libc6", "libllvm15"})
    finding = by_name(doctor.examine({}))["LLVM"]
    assert not finding.ok
    assert finding.remedy.startswith("# install LLVM 17 or newer")


def test_with_cuda_no_llvm_is_asked_for(monkeypatch):
    facts = {"drjit": "1", "mitsuba": "3", "cuda": True, "variant": "cuda_ad_rgb", "sum": 2.0}
    pretend(monkeypatch, truth=Probe(facts))
    found = by_name(doctor.examine({}))
    assert found["variant"] == Finding("variant", "cuda_ad_rgb")
    assert found["LLVM"].ok


def test_a_python_package_that_lacks_is_installed_at_the_version_asked_for(monkeypatch):
    pretend(monkeypatch, truth=Probe({"drjit": "1.5.0"}, "ModuleNotFoundError: No module named 'mitsuba'"))
    assert by_name(doctor.examine({}))["Mitsuba"].remedy.endswith("-m pip install mitsuba==3.9.1")


@pytest.mark.parametrize(
    ("change", "words"),
    [({"code": 330}, "the shaders need OpenGL 4.1"), ({"pixel": [0, 0, 0, 0]}, "a cleared pixel")],
)
def test_a_driver_that_opens_and_does_not_do(monkeypatch, change, words):
    pretend(monkeypatch, gl=Probe(WORKS_GL.facts | change))
    found = by_name(doctor.examine({}))["OpenGL"]
    assert not found.ok
    assert words in found.note


# --- showing ------------------------------------------------------------------------------------------------


def test_exit_code_and_json(monkeypatch, capsys):
    pretend(monkeypatch)
    assert doctor.run(json=True) == 0
    assert json.loads(capsys.readouterr().out)["ok"] is True
    pretend(monkeypatch, gl=Probe({"moderngl": "5"}, "Exception: no"))
    assert doctor.run(json=True) == 1
    document = json.loads(capsys.readouterr().out)
    assert document["ok"] is False
    assert [finding["name"] for finding in document["findings"] if not finding["ok"]] == ["OpenGL"]


def test_commands_are_on_lines_of_their_own(monkeypatch, capsys):
    pretend(monkeypatch, gl=Probe({"moderngl": "5"}, "Exception: no"))
    with_apt(monkeypatch, {"libc6"})
    assert doctor.run() == 1
    assert "  sudo apt-get install -y libegl1 libgl1 libgl1-mesa-dri" in capsys.readouterr().out.splitlines()


def test_a_terminal_gets_a_table(monkeypatch, capsys):
    pretend(monkeypatch, gl=Probe({"moderngl": "5"}, "Exception: [brackets] are no markup"))
    with_apt(monkeypatch, {"libc6"})
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True, raising=False)
    assert doctor.run() == 1
    shown = capsys.readouterr().out
    assert "[brackets]" in shown
    assert "sudo apt-get install -y libegl1 libgl1 libgl1-mesa-dri" in shown


# --- the fingerprint ----------------------------------------------------------------------------------------


def test_a_fingerprint_is_plain_json_and_complete():
    made = device.fingerprint("llvmpipe (LLVM 19.1.7, 256 bits)", "4.5 (Core Profile) Mesa 25.0.7")
    assert json.loads(json.dumps(made)) == made
    assert made["gl_software"] is True
    assert made["cores"] >= 1
    assert all(made[key] for key in ("cpu", "mitsuba", "drjit", "lightmeter", "python", "os"))


def test_a_fingerprint_loads_no_renderer():
    source = (
        "import json, sys; from lightmeter import device; made = device.fingerprint();"
        "print(json.dumps({'loaded': [n for n in ('mitsuba', 'drjit', 'moderngl') if n in sys.modules],"
        "'variant': made['variant'], 'llvm': made['llvm'], 'gl_software': made['gl_software']}))"
    )
    facts = run_probe(source, os.environ).facts
    assert facts == {"loaded": [], "variant": None, "llvm": None, "gl_software": None}


def test_a_fingerprint_names_the_variant_in_use():
    source = (
        "import json, mitsuba; mitsuba.set_variant('llvm_ad_rgb'); from lightmeter import device;"
        "made = device.fingerprint(); print(json.dumps({key: made[key] for key in ('variant', 'llvm')}))"
    )
    facts = run_probe(source, os.environ).facts
    assert facts["variant"] == "llvm_ad_rgb"
    assert int(facts["llvm"].split(".")[0]) >= MINIMUM_LLVM


@pytest.mark.parametrize(
    ("renderer", "software"),
    [
        ("llvmpipe (LLVM 15.0.6, 256 bits)", True),
        ("ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero)))", True),
        ("NVIDIA GeForce RTX 4070/PCIe/SSE2", False),
        ("Mesa Intel(R) UHD Graphics 620 (KBL GT2)", False),
    ],
)
def test_software_rasterisers_are_known(renderer, software):
    assert device.is_software(renderer) is software
