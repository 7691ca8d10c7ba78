"""Environment maps from files, and those built in."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.model import Environment, Image, Vector

LARGEST = 1 << 26
"""Texels of a map: 8192 × 8192."""

SMALLEST = (2, 1)
"""Width and height of a map."""


BUILT_IN = {
    "sky": "a clear sky with its sun at 45° over a grey ground",
    "studio": "soft boxes in a dark grey room",
}
"""Maps that need no file."""


def built_in(
    name: str,
    radiance: Vector = (1.0, 1.0, 1.0),
    degrees: float = 0.0,
    elevation: float | None = None,
    turbidity: float | None = None,
) -> Environment:
    """The environment of a built-in map.

    Args:
        name: in `BUILT_IN`.
        radiance, degrees: as of `environment_from`.
        elevation, turbidity: of the sky, see `sky.sky`; None: its own.
    """
    from lightmeter.scenes.sky import sky
    from lightmeter.scenes.studio import studio

    given = {"elevation": elevation, "turbidity": turbidity}
    chosen = {key: value for key, value in given.items() if value is not None}
    image = sky(**chosen) if name == "sky" else studio()
    return Environment(radiance, image, float(np.radians(degrees)))


def environment_from(
    path: Path,
    radiance: Vector = (1.0, 1.0, 1.0),
    degrees: float = 0.0,
    clamp: bool = False,
    note: Callable[[str], None] = lambda _text: None,
) -> Environment:
    """The environment of a latitude-longitude map, OpenEXR or Radiance HDR.

    Args:
        radiance: a factor for its texels.
        degrees: by which it is turned about +Y, anticlockwise as seen from above.
        clamp: whether texels that are negative or not finite are mended, and told to `note`; else they are an error.

    Raises:
        SceneError: it is missing, damaged, no such file, or holds texels that no light can have.
    """
    from lightmeter.scenes.image_files.image_error import ImageError
    from lightmeter.scenes.image_files.reading import read_image

    try:
        texels = read_image(path, encoding="linear", max_pixels=LARGEST)
    except ImageError as error:
        raise SceneError(
            "the environment map cannot be read",
            where=str(path),
            actual=str(error),
            remedy=f"use an .hdr or .exr file, or a built-in map: {', '.join(BUILT_IN)}",
        ) from None
    return Environment(radiance, Image(_checked(texels, clamp, str(path), note), path.name), float(np.radians(degrees)))


def _checked(texels: np.ndarray, clamp: bool, where: str, note: Callable[[str], None]) -> np.ndarray:
    """The texels once they are light: finite and not negative."""
    height, width = texels.shape[:2]
    if (width, height) < SMALLEST:
        raise SceneError(
            "the environment map is too small", where=where, expected="2 × 1 texels", actual=f"{width} × {height}"
        )
    counts = {
        "negative": int((texels < 0).any(axis=2).sum()),
        "infinite": int(np.isinf(texels).any(axis=2).sum()),
        "NaN": int(np.isnan(texels).any(axis=2).sum()),
    }
    found = ", ".join(f"{count} {kind}" for kind, count in counts.items() if count)
    if not found:
        return texels
    if not clamp:
        first = np.argwhere(~np.isfinite(texels).all(axis=2) | (texels < 0).any(axis=2))[0]
        raise SceneError(
            "the environment map holds texels that no light can have",
            where=where,
            expected="finite values of 0 or more",
            actual=f"{found}, the first at column {first[1]}, row {first[0]}",
            remedy="mend the file, or clamp them with `clamp = true` (--environment-clamp)",
        )
    finite = texels[np.isfinite(texels)]
    highest = float(finite.max(initial=0.0))
    note(f"environment map {where}: clamped {found} texels of {width * height} (to 0, to {highest:g} and to 0)")
    return np.clip(np.nan_to_num(texels, nan=0.0, posinf=highest, neginf=0.0), 0.0, None)


def as_seen(environment: Environment, size: tuple[int, int]) -> np.ndarray:
    """(H, W, 3) float32: a map of the whole environment, its factor and its rotation in it.

    A map keeps its own size and, where its rotation is a whole number of its columns, its own texels; else they are
    bilinear between two columns, as they are looked up.

    Args:
        size: width and height for a constant environment.
    """
    if environment.map is None:
        return np.broadcast_to(np.float32(environment.radiance), (size[1], size[0], 3)).copy()
    texels = environment.map.texels.astype(np.float64) * environment.radiance
    shift = environment.rotation / (2 * np.pi) * texels.shape[1]
    whole, part = np.floor(shift), shift - np.floor(shift)
    if min(part, 1 - part) < 1e-9:
        return np.roll(texels, -round(shift), axis=1).astype(np.float32)
    left = np.roll(texels, -int(whole), axis=1)
    return ((1 - part) * left + part * np.roll(left, -1, axis=1)).astype(np.float32)
