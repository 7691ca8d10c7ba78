"""What the benchmarks share that judge techniques in tables: their options, the tables as they come, the machine."""

import argparse
from collections.abc import Iterable
from pathlib import Path

from lightmeter.device import fingerprint
from lightmeter.realtime.device import Device


def parser(about: str, size: int) -> argparse.ArgumentParser:
    """Options for the images that are judged, and for the file.

    Args:
        about: the benchmark's docstring, whose first line is shown.
        size: pixels a side where none is given.
    """
    made = argparse.ArgumentParser(description=about.splitlines()[0])
    made.add_argument("--size", type=int, default=size, metavar="N", help="of the judged images (%(default)s)")
    made.add_argument("--spp", type=int, default=256, metavar="N", help="samples of the truth (%(default)s)")
    made.add_argument("--output", type=Path, metavar="FILE", help="write the tables here")
    return made


def publish(tables: Iterable[str], output: Path | None) -> None:
    """Prints every table as it comes, and writes all so far, so that a run that is stopped leaves something."""
    text = ""
    for table in tables:
        print(table, flush=True)
        text += table + "\n"
        if output:
            output.write_text(text, encoding="utf-8")


def machine(device: Device) -> str:
    """The machine's fingerprint in a line."""
    facts = fingerprint(device.renderer, device.version)
    return ", ".join(f"{name} {value}" for name, value in facts.items() if value is not None)
