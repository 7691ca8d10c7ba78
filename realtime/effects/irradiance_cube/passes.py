"""The cube."""

from typing import Any

from ...environments.lobes import diffuse_cube
from ...environments.passes import BakedPasses
from ...environments.source import environment_source


class Passes(BakedPasses):
    """Irradiance over π."""

    def bake(self) -> dict[str, Any]:
        """The cube's atlas."""
        source = environment_source(self.device, self.environment)
        size, samples, filtered = (self.knobs[name] for name in ("size", "samples", "filtered"))
        return {"irradiance_atlas": diffuse_cube(self.device, source, int(size), int(samples), bool(filtered))}
