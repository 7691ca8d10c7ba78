"""What effects bake: made once for a frame's plan, not once a frame, and timed by itself."""

import time
from collections.abc import Callable
from typing import Any

from .device import Device


class Baking:
    """Keeps what was baked, so that a frame's passes and those for its measurement share it.

    Attributes:
        milliseconds: effect to the time its baking took: wall time until the device was done, shaders compiled in it.
    """

    def __init__(self, device: Device) -> None:
        self._device = device
        self._kept: dict[str, Any] = {}
        self.milliseconds: dict[str, float] = {}

    def of(self, effect: str, bake: Callable[[], Any]) -> Any:
        """What the effect bakes, baked when it is first asked for; None where the scene gives it nothing to bake."""
        if effect not in self._kept:
            self._device.finish()
            start = time.perf_counter()
            self._kept[effect] = bake()
            self._device.finish()
            if self._kept[effect] is not None:
                self.milliseconds[effect] = (time.perf_counter() - start) * 1e3
        return self._kept[effect]
