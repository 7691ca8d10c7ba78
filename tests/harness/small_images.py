"""Small images on disk."""

from pathlib import Path

import numpy as np

from lightmeter.reports.image_files import write_exr


def noise(width: int = 24, height: int = 16, seed: int = 1) -> np.ndarray:
    """(H, W, 3) float32 in 0…1."""
    return np.random.default_rng(seed).random((height, width, 3), dtype=np.float32)


def png(path: Path, values: np.ndarray) -> Path:
    """8-bit code values of 0…1."""
    from PIL import Image

    Image.fromarray((np.clip(values, 0, 1) * 255 + 0.5).astype(np.uint8)).save(path)
    return path


def exr(path: Path, values: np.ndarray) -> Path:
    """Scene-linear."""
    return write_exr(path, values)


def hdr(path: Path, values: np.ndarray) -> Path:
    """Radiance RGBE, plain scanlines."""
    height, width = values.shape[:2]
    mantissa, exponent = np.frexp(values.max(axis=2))
    scale = np.where(values.max(axis=2) > 0, mantissa * 256 / np.maximum(values.max(axis=2), 1e-30), 0)
    pixels = np.zeros((height, width, 4), np.uint8)
    pixels[..., :3] = np.clip(values * scale[..., None], 0, 255)
    pixels[..., 3] = exponent + 128
    path.write_bytes(
        b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + f"-Y {height} +X {width}\n".encode() + pixels.tobytes()
    )
    return path
