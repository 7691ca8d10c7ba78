"""The fitted table, as the textures that the shader reads."""

import json
from functools import cache
from pathlib import Path

import numpy as np

from ...effect import Knobs

TABLE = Path(__file__).parent / "table.json"


@cache
def fitted() -> np.ndarray:
    """(side, side, 6) float64, see `fit.make_table`; rows are roughness, columns √(1 − n·v)."""
    return np.array(json.loads(TABLE.read_text(encoding="utf-8"))["table"])


def tables(_knobs: Knobs) -> dict[str, np.ndarray]:
    """Two textures, (side, side, 4) float32 each."""
    numbers = fitted()
    return {"cosine_table": numbers[..., :4], "albedo_table": np.pad(numbers[..., 4:], ((0, 0), (0, 0), (0, 2)))}
