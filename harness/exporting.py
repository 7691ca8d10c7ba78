"""A scene written as the files that another engine reads."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from lightmeter.reports.image_files import write_exr
from lightmeter.reports.one_step import in_one_step
from lightmeter.scenes.environments import as_seen
from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.export import ENVIRONMENT_FILE, camera_document, gltf_files
from lightmeter.scenes.model import Scene

ENVIRONMENT_SIZE = (64, 32)
"""Width and height of a constant environment's image."""


@dataclass(frozen=True)
class Exported:
    """What `export` wrote.

    Attributes:
        folder: where everything lies.
        gltf, camera: scene.gltf and camera.json.
        environment: environment.exr, or None where the scene has no environment.
        files: every file, the buffer and the textures included, in the order they were written.
        notes: what glTF cannot say, or an engine may not read as it is meant.
    """

    folder: Path
    gltf: Path
    camera: Path
    environment: Path | None
    files: tuple[Path, ...]
    notes: tuple[str, ...]


def export(scene: Scene, size: tuple[int, int], folder: Path) -> Exported:
    """Write scene.gltf with what it names, environment.exr and camera.json, each file in one step.

    camera.json comes last: in a fresh folder, once it is there, so is all the rest.

    Args:
        scene: the scene.
        size: the image's width and height in pixels.
        folder: made where it is missing.

    Raises:
        SceneError: the scene holds a number that is not finite, or a texture that glTF cannot hold.
        OSError: the folder cannot be written to.
        ImageError: environment.exr cannot be written.
    """
    made = gltf_files(scene, size)
    document, camera = (_json(content, scene) for content in (made.content, camera_document(scene, size)))
    files = [_write(folder / name, data) for name, data in made.files.items()]
    files.append(_write(folder / "scene.gltf", document))
    environment = None
    if scene.environment is not None:
        environment = write_exr(folder / ENVIRONMENT_FILE, as_seen(scene.environment, ENVIRONMENT_SIZE))
        files.append(environment)
    files.append(_write(folder / "camera.json", camera))
    return Exported(folder, folder / "scene.gltf", files[-1], environment, tuple(files), made.notes)


def _json(content: dict[str, Any], scene: Scene) -> bytes:
    """Strict JSON in UTF-8; what a name holds that UTF-8 cannot say (a file name's stray byte) becomes "?"."""
    try:
        text = json.dumps(content, ensure_ascii=False, allow_nan=False, indent=1)
    except ValueError:
        raise SceneError(
            "the scene cannot be exported: it holds a number that is not finite",
            where=scene.name,
            remedy="check its positions, matrices and lights",
        ) from None
    return text.encode("utf-8", errors="replace")


def _write(path: Path, data: bytes) -> Path:
    with in_one_step(path) as partial:
        partial.write_bytes(data)
    return path
