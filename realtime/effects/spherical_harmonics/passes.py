"""The coefficients."""

from typing import Any

from ...environments.moments import moments
from ...environments.passes import BakedPasses
from . import band_weights


class Passes(BakedPasses):
    """The environment projected on the harmonics."""

    def bake(self) -> dict[str, Any]:
        """A texture of one row, a coefficient a column."""
        weights = band_weights(int(self.knobs["order"]), str(self.knobs["window"]))
        return {"sh_coefficients": moments(self.device, self.environment, "sh_irradiance.glsl", weights)}
