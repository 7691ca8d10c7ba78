"""The map."""

from typing import Any

from ...environment_map import EnvironmentMap
from ...environments.passes import BakedPasses


class Passes(BakedPasses):
    """Nothing is filtered."""

    def bake(self) -> dict[str, Any]:
        """The map as a texture."""
        return EnvironmentMap(self.device, self.environment).textures
