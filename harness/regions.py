"""Regions: which pixels of an image a limit is on, by what the camera sees there."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from lightmeter.failures import UsageError
from lightmeter.hints import nearest
from lightmeter.scenes.model import Scene


@dataclass(frozen=True)
class Region:
    """Pixels whose centre sees certain things.

    Attributes:
        kind: "surfaces" leaves the background out.
        names: of objects or materials; a pixel counts where it sees any of them.
    """

    kind: Literal["everywhere", "surfaces", "object", "material"]
    names: tuple[str, ...] = ()

    @property
    def words(self) -> str:
        """ "without background", "on object ball, table", or "" for the whole image."""
        if self.kind == "everywhere":
            return ""
        return "without background" if self.kind == "surfaces" else f"on {self.kind} {', '.join(self.names)}"

    def check(self, scene: Scene, place: str) -> None:
        """Raises UsageError where the scene has no such object or material; names the nearest."""
        known = {self._name(shape) for shape in scene.shapes}
        for name in self.names:
            if name not in known:
                raise UsageError(
                    f"{place}.region: {scene.name} has no {self.kind} {name!r}; {nearest(name, sorted(known))}"
                )

    def mask(self, scene: Scene, seen: np.ndarray, place: str) -> np.ndarray | None:
        """(H, W) bool, True where pixels count; None where all do.

        Args:
            seen: (H, W) int, the index of the shape that each pixel's centre sees, −1 where it sees none.

        Raises:
            UsageError: no pixel counts.
        """
        if self.kind == "everywhere":
            return None
        if self.kind == "surfaces":
            found = seen >= 0
        else:
            found = np.isin(seen, [i for i, shape in enumerate(scene.shapes) if self._name(shape) in self.names])
        if not found.any():
            raise UsageError(
                f"{place}.region: no pixel of {scene.name} is {self.words or 'seen'}; it is out of sight, or the size "
                "is too small"
            )
        return found

    def _name(self, shape) -> str:
        return shape.material.name if self.kind == "material" else shape.name


EVERYWHERE = Region("everywhere")
