"""`lightmeter doctor`: what this machine has, and the exact command for what it lacks.

Both renderers are tried in child processes, because both can take the process down with them: a GL driver may
crash, and Dr.Jit aborts when the LLVM it found cannot compile for it (14, 15 and 16 cannot).

The same examination tells the set-up script what to install: `python -m lightmeter.doctor --packages`.
"""

import json as jsonlib
import os
import sys
from collections.abc import Mapping, Sequence
from dataclasses import asdict

from lightmeter import device
from lightmeter.examination import install
from lightmeter.examination.finding import Finding
from lightmeter.examination.opengl import examine_gl
from lightmeter.examination.truth import examine_truth


def examine(environ: Mapping[str, str] | None = None) -> list[Finding]:
    """Everything lightmeter needs on this machine, in the order it is shown."""
    environ = os.environ if environ is None else environ
    processor = Finding("CPU", f"{device.cpu_model()}, {device.cores()} cores")
    return [_python(), processor, examine_gl(environ), *examine_truth(environ)]


def _python() -> Finding:
    version = ".".join(map(str, sys.version_info[:3]))
    return Finding("Python", f"{version}, {sys.executable}, {device.operating_system()}")


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
    together = [install.system_packages(packages, "")] if packages else []
    others = [finding.remedy for finding in findings if finding.remedy and not finding.packages]
    return together + list(dict.fromkeys(others))


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
