"""`load`: a scene from whatever names it."""

from pathlib import Path

from lightmeter.scenes.model import Scene


def load(source: str | Path, camera: str | int | None = None) -> Scene:
    """The scene that `source` names.

    Args:
        source: a name in the library, `stiff/` and that of a stiff scene, or the path of a `.toml`, `.gltf` or `.glb`
            file.
        camera: which of a glTF file's cameras, by its name or its number from 0; the first unless given.

    Raises:
        SceneError: there is no such scene, or its file is wrong.
    """
    from lightmeter.scenes import library
    from lightmeter.scenes.errors import SceneError, nearest, shown

    text = str(source)
    suffix = Path(text).suffix.lower()
    if suffix in (".gltf", ".glb"):
        from lightmeter.scenes.gltf import load_gltf

        return load_gltf(Path(text), camera)
    if camera is not None:
        raise SceneError(
            "a camera can only be chosen in a glTF file", where=text, remedy="write it into the scene file"
        )
    if suffix == ".toml":
        from lightmeter.scenes.toml import load_toml

        return load_toml(Path(text))
    if text in library.names():
        return library.load(text)
    if text.startswith("stiff/"):
        from lightmeter.scenes.stiff import load_stiff

        return load_stiff(text)
    raise SceneError(
        f"there is no scene {shown(text)}",
        expected="a name in the library, a .toml, a .gltf or a .glb",
        remedy=nearest(text, library.names()),
    )
