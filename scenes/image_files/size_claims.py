"""Sizes that a file claims, judged before memory is asked for.

A file of a hundred bytes can claim a picture of a terabyte. Two rules keep that from becoming an allocation:
a limit on the picture, and what the file's compression can hold at best.
"""

import os

from lightmeter.scenes.image_files.image_error import ImageError

MAX_PIXELS = 2**26  # 8192 × 8192, 768 MiB as float32 RGB: beyond what a frame comparison needs


def check_size(where: str | os.PathLike[str], width: int, height: int, max_pixels: int = MAX_PIXELS) -> None:
    """Refuse a picture without pixels or with more than `max_pixels`.

    Raises:
        ImageError: it is one.
    """
    if width < 1 or height < 1:
        raise ImageError("impossible size", where=where, expected="at least 1×1 pixels", actual=f"{width}×{height}")
    if width * height > max_pixels:
        raise ImageError(
            "too large, or damaged",
            where=where,
            expected=f"at most {max_pixels:,} pixels",
            actual=f"a claim of {width}×{height}",
            remedy="Crop or scale the image; if it is small, write it again",
        )


def check_content(where: str | os.PathLike[str], claimed: int, present: int, ratio: float) -> None:
    """Refuse a file whose `present` bytes cannot unpack to the `claimed` ones at `ratio` to one.

    Raises:
        ImageError: it is one.
    """
    if claimed > present * ratio:
        raise ImageError(
            "damaged, cut short or not what it claims",
            where=where,
            expected=f"at least {int(claimed / ratio):,} bytes for the size in its header",
            actual=f"{present:,} bytes",
            remedy="Write or copy the file again",
        )
