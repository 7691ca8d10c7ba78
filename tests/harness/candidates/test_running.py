"""Commands that misbehave: each is ended in time, with a message of what it said last, and nothing goes on running."""

import os
import sys
import time
from pathlib import Path

import pytest

from lightmeter.candidates.failure import CandidateError
from lightmeter.candidates.running import KEPT, run

PYTHON = sys.executable


def refused(script: str, timeout: float = 20.0) -> str:
    with pytest.raises(CandidateError) as raised:
        run([PYTHON, "-c", script], timeout, {})
    return str(raised.value)


def test_a_command_that_ends_well_gives_its_time_and_output(tmp_path):
    log = tmp_path / "log"
    ran = run([PYTHON, "-c", "import os; print(os.environ['OF_THE_TEST'])"], 20, {"OF_THE_TEST": "said"}, log)
    assert ran.output.strip() == log.read_text().strip() == "said"
    assert 0 < ran.seconds < 20


def test_a_code_other_than_0_is_shown_with_the_last_output():
    message = refused("import sys; print('first'); print('no display', file=sys.stderr); sys.exit(3)")
    assert "exit code 3" in message
    assert "no display" in message


def test_a_signal_is_told_from_a_code():
    assert "signal 9" in refused("import os; os.kill(os.getpid(), 9)")


def test_a_program_that_is_not_there():
    with pytest.raises(CandidateError, match="'no-such-engine' cannot be started"):
        run(["no-such-engine"], 5, {})


def test_a_sleeper_is_ended_with_what_it_started(tmp_path):
    noted = tmp_path / "pid"
    script = (
        "import subprocess, sys, time, pathlib\n"
        f"child = subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(60)'])\n"
        f"pathlib.Path({str(noted)!r}).write_text(str(child.pid))\n"
        "time.sleep(60)"
    )
    start = time.perf_counter()
    assert "within 2 s" in refused(script, timeout=2)
    assert time.perf_counter() - start < 15
    child = int(noted.read_text())
    for _ in range(50):  # the child's own parent is gone: wait until somebody has taken its end note of
        if not _runs(child):
            break
        time.sleep(0.1)
    assert not _runs(child)


def _runs(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    stat = Path(f"/proc/{pid}/stat")
    return not stat.exists() or stat.read_text().rsplit(")", 1)[1].split()[0] != "Z"


def test_endless_output_neither_fills_memory_nor_blocks():
    message = refused("while True: print('frame ' * 100)", timeout=1.5)
    assert "within 1.5 s" in message
    assert len(message) < 1000


def test_of_much_output_the_end_is_kept():
    ran = run([PYTHON, "-c", f"print('x' * {4 * KEPT}); print('the end')"], 20, {})
    assert ran.output.endswith("the end\n")
    assert len(ran.output) <= KEPT


def test_output_that_is_no_text_is_shown_without_control_characters():
    message = refused(r"import sys; sys.stdout.buffer.write(b'\x1b[31m\xff\x00 bad'); sys.exit(1)")
    assert "\x1b" not in message
    assert "bad" in message
