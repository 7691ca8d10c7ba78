"""A reference as a portable folder: EXR batches and a manifest, for CI to cache or commit."""

import json
from collections.abc import Callable
from pathlib import Path

from lightmeter.groundtruth import batch_file, content
from lightmeter.groundtruth.batch_file import DamagedFileError
from lightmeter.groundtruth.batches import REFERENCE, Reference, batch_name, collect
from lightmeter.groundtruth.scattering import SINGLE
from lightmeter.groundtruth.store import Series
from lightmeter.scenes.errors import shown
from lightmeter.scenes.model import Scene
from lightmeter.scenes.true_surface import is_true_surface, true_surface

MANIFEST = "manifest.json"
SCHEMA = 1


class ReferenceFolderError(ValueError):
    """A folder is no reference, is damaged, or belongs to another scene; the message says how to mend it."""


def save(folder: Path, scene: Scene, reference: Reference) -> int:
    """Writes a reference to a folder; returns the bytes written. The manifest comes last."""
    height, width = reference.batches.shape[1:3]
    of = Series.of(REFERENCE, scene, (width, height), reference.spp, reference.seed, reference.scattering)
    count, total = len(reference.batches), 0
    digests = {}
    for batch, image in enumerate(reference.batches):
        name = f"{batch_name(batch)}.exr"
        metadata = of.metadata | {"key": reference.key, "name": batch_name(batch)}
        total += batch_file.write(folder / name, {"": image}, metadata)
        digests[name] = batch_file.pixel_digest({"": image})
    manifest = {
        "schema": SCHEMA,
        "scene": scene.name,
        "scene_key": reference.scene_key,
        "key": reference.key,
        "size": [width, height],
        "spp": reference.spp,
        "batches": count,
        "seed": reference.seed,
        "truth": reference.scattering,
        "seconds": round(reference.seconds, 3),
        "versions": content.versions(),
        "definition": content.definition_key()[:16],
        "files": digests,
    }
    text = json.dumps(manifest, indent=2) + "\n"
    unfinished = folder / f"{batch_file.TEMPORARY}{MANIFEST}"
    unfinished.write_text(text, encoding="utf-8")
    unfinished.replace(folder / MANIFEST)
    return total + len(text)


def load(
    folder: Path,
    scene: Scene,
    size: tuple[int, int] | None = None,
    say: Callable[[str], None] = lambda message: None,
    scattering: str = SINGLE,
) -> Reference:
    """The reference in a folder, once it is sure that it belongs to the scene.

    Args:
        size: (width, height) that it must have; None takes what it has.
        say: told where it was made by other versions, which does not stop it.
        scattering: which truth it must be of.

    Raises:
        ReferenceFolderError: with what is wrong and how to mend it.
    """
    manifest = _manifest(folder)
    surface = "--true-surface " if is_true_surface(scene) else ""
    command = f"lightmeter reference {scene.name} {surface}-o {folder}"
    again = f"make it again with `{command}`"
    if manifest["scene_key"] != content.scene_key(scene):
        raise ReferenceFolderError(f"{folder / MANIFEST}: {_of_another(manifest, scene)}{again}")
    width, height = manifest["size"]
    if manifest["truth"] != scattering:
        raise ReferenceFolderError(
            f"{folder / MANIFEST}: expected the truth {scattering!r}, got {shown(manifest['truth'])}; "
            f"pass the `--truth` that it was made with, or make it again with `{command} --truth {scattering}`"
        )
    if size is not None and (width, height) != tuple(size):
        raise ReferenceFolderError(
            f"{folder / MANIFEST}: expected {size[0]} × {size[1]} pixels, got {width} × {height}; "
            f"pass `--size {width}x{height}`, or make it again with `{command} --size {size[0]}x{size[1]}`"
        )
    for what, mine in (("versions", content.versions()), ("definition", content.definition_key()[:16])):
        if manifest[what] != mine:
            say(f"{folder}: the reference was made with other {what} ({manifest[what]}; here: {mine})")
    images = []
    for name, wanted in manifest["files"].items():
        try:
            layers, metadata = batch_file.read(folder / name, (width, height))
        except FileNotFoundError:
            raise ReferenceFolderError(f"{folder / name} is missing; {again}") from None
        except DamagedFileError as error:
            raise ReferenceFolderError(f"{error}; {again}") from None
        if metadata["sha256"] != wanted or "" not in layers:
            raise ReferenceFolderError(f"{folder / name} is not the file that {MANIFEST} lists; {again}")
        images.append(layers[""])
    of = Series.of(REFERENCE, scene, (width, height), manifest["spp"], manifest["seed"], scattering)
    found = collect(images, of, manifest["seconds"], len(images), scattering)
    return Reference(**{**vars(found), "key": manifest["key"]})


def _of_another(manifest: dict, scene: Scene) -> str:
    """What is wrong with a reference whose scene is not the one asked for; a remedy follows."""
    scenes = f"its scene is {manifest['scene']!r}, the one asked for {scene.name!r}"
    if is_true_surface(scene):
        return (
            "an effect draws another surface than the true one, and the reference is not of the true one, or of "
            f"another scene, or of an earlier state of it ({scenes}); "
        )
    if manifest["scene_key"] == content.scene_key(true_surface(scene)):
        return "the reference is of the true surface, and no effect draws another; prefer one with `--use`, or "
    return f"the reference is of another scene, or of an earlier state of it ({scenes}); "


_EXPECTED = {
    "scene": str,
    "scene_key": str,
    "key": str,
    "size": list,
    "spp": int,
    "batches": int,
    "seed": int,
    "truth": str,
    "seconds": (int, float),
    "versions": str,
    "definition": str,
    "files": dict,
}


def _manifest(folder: Path) -> dict:
    path = folder / MANIFEST
    hint = "a folder that `lightmeter reference SCENE -o DIR` wrote holds it"
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise ReferenceFolderError(f"{path} is missing; {hint}") from None
    except (OSError, UnicodeDecodeError) as error:
        raise ReferenceFolderError(f"{path} cannot be read ({error}); {hint}") from None
    try:
        manifest = json.loads(text)
    except (json.JSONDecodeError, RecursionError) as error:
        raise ReferenceFolderError(f"{path} is not JSON ({error}); {hint}") from None
    if not isinstance(manifest, dict) or manifest.get("schema") != SCHEMA:
        found = manifest.get("schema") if isinstance(manifest, dict) else None
        raise ReferenceFolderError(f"{path}: schema: expected {SCHEMA}, got {found!r}; {hint}")
    manifest.setdefault("truth", SINGLE)  # references made before there was another
    for key, kind in _EXPECTED.items():
        if not isinstance(manifest.get(key), kind) or isinstance(manifest.get(key), bool):
            raise ReferenceFolderError(f"{path}: {key} is missing or of the wrong type; {hint}")
    size, files = manifest["size"], manifest["files"]
    if len(size) != 2 or not all(isinstance(n, int) and 1 <= n <= 16384 for n in size):
        raise ReferenceFolderError(f"{path}: size: expected two numbers from 1 to 16384, got {size!r}"[:200])
    if len(files) < 2 or len(files) != manifest["batches"]:
        raise ReferenceFolderError(f"{path}: files: expected {manifest['batches']} batches, got {len(files)}")
    for name in files:
        if Path(name).name != name:
            raise ReferenceFolderError(f"{path}: files: {name!r} is not a plain file name")
    return manifest
