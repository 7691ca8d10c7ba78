"""What can be wrong with a frame as a whole, before any of its pixels is judged."""

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class Fault:
    """Something that is wrong with a frame, and by how much.

    Attributes:
        name: "flip", "shift", "field_of_view", "transfer", "exposure", "alpha" or "background".
        words: one sentence with the size: "shifted by 0.50 pixels right and 0.02 down".
        size: the same as numbers; docs/registration.md lists the keys and their units.
    """

    name: str
    words: str
    size: Mapping[str, float]
