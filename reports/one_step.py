"""Files that are written in one step: a reader sees the old file or the whole new one."""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path


@contextmanager
def in_one_step(path: str | os.PathLike[str]) -> Iterator[Path]:
    """A path to write to, whose file takes the place of the one at `path` where all went well, and else is removed.

    The path is beside the one that is meant, and ends as it does. The folder is made where it lacks.

    Raises:
        OSError: it cannot be written; names the path that is meant.
    """
    target = Path(path)
    target.parent.mkdir(parents=True, exist_ok=True)
    partial = target.with_name(f".{target.name}.{os.getpid()}.part{target.suffix}")
    try:
        yield partial
        partial.replace(target)
    except OSError as error:
        raise OSError(error.errno, f"cannot be written ({error.strerror or error})", str(target)) from None
    finally:
        with suppress(OSError):
            partial.unlink()


def write_text(path: str | os.PathLike[str], text: str) -> Path:
    """Write UTF-8 text in one step; gives the path. Raises as `in_one_step`."""
    with in_one_step(path) as partial:
        partial.write_text(text, encoding="utf-8")
    return Path(path)
