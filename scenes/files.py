"""Reading the files of a scene, and the rule for the files that a file names.

A name in a scene file is relative to that file's folder and stays inside it: no absolute path, no climbing
out with `..`, no symbolic link that leads out, no network address. So a scene folder can be moved, and a
scene from a stranger cannot read this machine's other files.
"""

import re
from pathlib import Path, PurePosixPath

from lightmeter.scenes.errors import SceneError, shown

LARGEST = 2**31
"""Bytes; a larger file is refused."""


def read_bytes(path: Path, limit: int = LARGEST, where: str = "") -> bytes:
    """The content of a regular file.

    Args:
        path: the file.
        limit: the most bytes it may hold.
        where: what names it, for the message; the path itself unless said.

    Raises:
        SceneError: it is missing, no regular file, unreadable or larger than `limit`.
    """
    where = where or str(path)
    try:
        if not path.exists():
            raise SceneError("there is no such file", where=where, remedy=f"looked for {path}")
        if not path.is_file():
            raise SceneError("this is not a file", where=where, actual=str(path))
        size = path.stat().st_size
        if size > limit:
            raise SceneError("the file is too large", where=where, expected=f"at most {limit} bytes", actual=f"{size}")
        return path.read_bytes()
    except (OSError, ValueError) as error:
        if isinstance(error, SceneError):
            raise
        raise SceneError(f"the file cannot be read ({error})", where=where) from None


def inside(folder: Path, name: str, where: str) -> Path:
    """The path of the file `name`, which must lie in `folder` or below.

    Raises:
        SceneError: it leads out of the folder.
    """
    fault = ""
    if re.match(r"[A-Za-z][A-Za-z0-9+.-]+:", name):
        fault = "this is an address, and nothing is fetched"
    elif not name or "\0" in name or len(name) > 1024:
        fault = "this is no file name"
    elif name.startswith(("/", "\\")) or re.match(r"[A-Za-z]:", name):
        fault = "this path is absolute"
    if not fault:
        try:
            path = (folder / PurePosixPath(name)).resolve()
            if path.is_relative_to(folder.resolve()):
                return path
            fault = "this path leads out of the scene's folder"
        except (OSError, RuntimeError, ValueError):
            fault = "this is no file name"
    raise SceneError(
        fault,
        where=where,
        expected="a path relative to the scene file, inside its folder",
        actual=shown(name),
        remedy="put the file beside the scene file or below",
    )
