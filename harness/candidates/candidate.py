"""What is said of a candidate before it is seen: where its frame comes from, and how its values are meant."""

from dataclasses import dataclass
from typing import Literal, get_args

Transfer = Literal["linear", "srgb", "gamma22", "display"]
TRANSFERS: dict[str, str] = {
    "linear": "scene-linear radiance",
    "srgb": "radiance clipped to 0…1 and encoded by the sRGB curve",
    "gamma22": "radiance clipped to 0…1, to the power 1/2.2",
    "display": "the display image of the scene: exposed, tone mapped and encoded as lightmeter's own frame",
}
assert set(TRANSFERS) == set(get_args(Transfer))

DEFAULT_TIMEOUT = 600.0
"""Seconds; a software rasteriser may take a minute to compile its shaders."""

OWN, FRAME = "lightmeter", "frame"
"""The names of our own renderer and of its frame's pictures, which no candidate can have."""

CORRECTABLE = ("flip", "shift", "field_of_view", "transfer", "exposure", "alpha")
"""What registration finds and can be asked to correct. It finds a missing background too, which nothing brings back."""


@dataclass(frozen=True)
class Unsupported:
    """What an engine cannot draw: pixels that show it are not judged.

    Attributes:
        materials, objects: by their names in the scene.
        background: whether pixels that see no surface are left out.
    """

    materials: tuple[str, ...] = ()
    objects: tuple[str, ...] = ()
    background: bool = False

    def __or__(self, other: "Unsupported") -> "Unsupported":
        """Everything that either of the two names."""
        return Unsupported(
            tuple(dict.fromkeys(self.materials + other.materials)),
            tuple(dict.fromkeys(self.objects + other.objects)),
            self.background or other.background,
        )


@dataclass(frozen=True)
class Candidate:
    """A renderer other than ours, or a frame that it left.

    Attributes:
        name: as reports call it; unique.
        source: "file", "command" or "renderer".
        text: the file's path, the command line, or the renderer's registered name; placeholders are not filled in yet.
        transfer: how the image's values are encoded; None: what the side file says, else "linear".
        exposure: stops that are in the image already; None: what the side file says, else 0.
        timeout: seconds that a command may take.
        environment: variables for a command, beside those that there are.
        register: faults that are to be corrected before the frame is measured.
        unsupported: what is not to be judged, beside what the side file says.
    """

    name: str
    source: Literal["file", "command", "renderer"]
    text: str
    transfer: Transfer | None = None
    exposure: float | None = None
    timeout: float = DEFAULT_TIMEOUT
    environment: tuple[tuple[str, str], ...] = ()
    register: tuple[str, ...] = ()
    unsupported: Unsupported = Unsupported()
