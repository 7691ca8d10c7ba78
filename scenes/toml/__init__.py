"""Scene files in TOML.

The keys are in `lightmeter.scenes.toml.entries`; `schema()` gives them as JSON Schema for editors.
"""

from pathlib import Path
from typing import Any

from lightmeter.scenes.model import Scene

LARGEST = 2**22
"""Bytes of a scene file."""


def schema() -> dict[str, Any]:
    """The scene file's JSON Schema (draft 2020-12)."""
    from lightmeter.scenes.toml.entries import SceneFile

    return {"$schema": "https://json-schema.org/draft/2020-12/schema"} | SceneFile.model_json_schema()


def load_toml(path: Path) -> Scene:
    """The scene in a TOML file; files that it names are found from its folder, and lie there or below.

    Raises:
        SceneError: the file is missing, no TOML, has unknown keys or values out of range, or names a file that
            is missing, damaged or out of its folder.
    """
    from lightmeter.scenes.files import read_bytes
    from lightmeter.scenes.toml.build import Builder

    path = Path(path)
    file = parse(read_bytes(path, LARGEST), str(path))
    return Builder(path.parent, str(path)).scene(file, path.stem)


def parse(data: bytes, where: str):
    """The checked content of a scene file, a `SceneFile`.

    Raises:
        SceneError: it is no TOML, or does not follow the schema.
    """
    from lightmeter.scenes.toml.entries import SceneFile
    from lightmeter.scenes.validation import read_toml

    return read_toml(data, SceneFile, where)
