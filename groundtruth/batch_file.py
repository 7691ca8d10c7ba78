"""One batch on disk: an OpenEXR file with its metadata in the header and a checksum at its end.

The file is an ordinary scan-line EXR (float32, zip) that any viewer opens. After its last chunk come 40 bytes that
viewers ignore: `LMSHA256` and the sha256 of everything before. So damage is found before OpenEXR's decoder, which
writes to the terminal on its own account, sees the file. It is written beside its place and renamed into it.
"""

import hashlib
import os
import secrets
from pathlib import Path

import numpy as np

_MARK = b"LMSHA256"
_PREFIX = "lightmeter."
TEMPORARY = ".unfinished-"


class DamagedFileError(ValueError):
    """A batch file is not what was written.

    Attributes:
        path: the file.
        reason: what is wrong, one clause.
    """

    def __init__(self, path: Path, reason: str):
        self.path, self.reason = path, reason
        super().__init__(f"{path} is damaged: {reason}")


def write(path: Path, layers: dict[str, np.ndarray], metadata: dict[str, str]) -> int:
    """Writes a batch, whole or not at all.

    Args:
        layers: (H, W, 3) float32 each, by name; the name "" gives plain R, G, B.
        metadata: kept in the header as text, each key with the prefix `lightmeter.`.

    Returns:
        The file's size in bytes.

    Raises:
        OSError: the file cannot be written: the disk is full, the folder may only be read.
    """
    import OpenEXR

    channels = {
        _channel(layer, c): np.ascontiguousarray(image[..., i], np.float32)
        for layer, image in layers.items()
        for i, c in enumerate("RGB")
    }
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    header |= {_PREFIX + key: str(value) for key, value in metadata.items()}
    header[_PREFIX + "sha256"] = pixel_digest(layers)
    path.parent.mkdir(parents=True, exist_ok=True)
    unfinished = path.parent / f"{TEMPORARY}{os.getpid()}-{secrets.token_hex(4)}.exr"
    try:
        try:
            OpenEXR.File(header, channels).write(str(unfinished))
        except RuntimeError as error:  # what OpenEXR makes of the system's errors
            raise OSError(f"{path} cannot be written ({str(error).rpartition('. ')[2].rstrip('.')})") from None
        content = unfinished.read_bytes()
        with unfinished.open("ab") as file:
            file.write(_MARK + hashlib.sha256(content).digest())
        unfinished.replace(path)
    finally:
        unfinished.unlink(missing_ok=True)
    return len(content) + 40


def read(path: Path, size: tuple[int, int] | None = None) -> tuple[dict[str, np.ndarray], dict[str, str]]:
    """Layers and metadata of a batch, verified.

    Args:
        size: (width, height) that it must have; checked before pixels are decoded.

    Raises:
        FileNotFoundError: it is not there.
        DamagedFileError: it was cut, changed, or is of another size.
    """
    import OpenEXR

    metadata = read_metadata(path, size)
    with OpenEXR.File(str(path), separate_channels=True) as file:
        planes = {name: channel.pixels.copy() for name, channel in file.channels().items()}
    names = sorted({name.rpartition(".")[0] for name in planes})
    try:
        layers = {n: np.stack([planes[_channel(n, c)] for c in "RGB"], axis=-1).astype(np.float32) for n in names}
    except KeyError as error:
        raise DamagedFileError(path, f"channel {error} is missing") from None
    if metadata.get("sha256") != pixel_digest(layers):
        raise DamagedFileError(path, "its pixels are not those its header speaks of")
    return layers, metadata


def read_metadata(path: Path, size: tuple[int, int] | None = None) -> dict[str, str]:
    """The metadata of a batch whose bytes are verified. Raises as `read` does."""
    import OpenEXR

    _verify(path)
    try:
        with OpenEXR.File(str(path), header_only=True) as file:
            header = dict(file.header())  # leaving the file empties it
    except (RuntimeError, ValueError, OSError) as error:
        raise DamagedFileError(path, f"OpenEXR cannot read it ({error})") from None
    low, high = header["dataWindow"]
    found = (int(high[0] - low[0]) + 1, int(high[1] - low[1]) + 1)
    if size is not None and found != tuple(size):
        raise DamagedFileError(path, f"expected {size[0]} × {size[1]} pixels, got {found[0]} × {found[1]}")
    return {k.removeprefix(_PREFIX): str(v) for k, v in header.items() if k.startswith(_PREFIX)}


def pixel_digest(layers: dict[str, np.ndarray]) -> str:
    """sha256 over the layers' names, sizes and float32 values, little endian."""
    state = hashlib.sha256()
    for name in sorted(layers):
        image = np.ascontiguousarray(layers[name], "<f4")
        state.update(f"{name}\0{image.shape}\0".encode())
        state.update(image)
    return state.hexdigest()


def _verify(path: Path) -> None:
    content = path.read_bytes()
    body, tail = content[:-40], content[-40:]
    if len(content) < 40 or not tail.startswith(_MARK):
        raise DamagedFileError(path, "its end is missing")
    if hashlib.sha256(body).digest() != tail[len(_MARK) :]:
        raise DamagedFileError(path, "its checksum does not match its content")


def _channel(layer: str, component: str) -> str:
    return f"{layer}.{component}" if layer else component
