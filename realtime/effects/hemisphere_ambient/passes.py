"""The two colours."""

from typing import Any

from ...environments.moments import moments
from ...environments.passes import BakedPasses


class Passes(BakedPasses):
    """The irradiance over π of what faces up, and of what faces down: exact there."""

    def bake(self) -> dict[str, Any]:
        """A texture of two texels: sky, ground."""
        return {"hemisphere_colors": moments(self.device, self.environment, "basis.glsl", (1.0, 1.0), self.folder)}
