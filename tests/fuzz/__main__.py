"""`python -m tests.fuzz --inputs 100000`: mutated files over all loaders; findings are kept as regression cases."""

import argparse
import sys
import time
from pathlib import Path

from .loaders import loaders
from .running import fuzz

CASES = Path(__file__).with_name("cases")


def main() -> int:
    known = loaders()
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("--inputs", type=int, default=9000, help="over all loaders together")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--loader", action="append", choices=sorted(known), help="only this one (repeatable)")
    parser.add_argument("--keep", type=Path, default=CASES, help="where findings are written")
    asked = parser.parse_args()
    names = asked.loader or list(known)
    findings = total = 0
    for name in names:
        start, count = time.perf_counter(), -(-asked.inputs // len(names))
        outcome = fuzz(known[name], count, asked.seed)
        total += count
        spent = time.perf_counter() - start
        print(f"{name}: {count} inputs, {outcome.read} read, {outcome.refused} refused, {spent:.0f} s", flush=True)
        for finding in outcome.findings:
            findings += 1
            asked.keep.mkdir(parents=True, exist_ok=True)
            (asked.keep / finding.name).write_bytes(finding.data)
            print(f"  {finding.name}: {finding.what}", flush=True)
    print(f"{total} inputs, {findings} findings")
    return int(findings > 0)


if __name__ == "__main__":
    sys.exit(main())
