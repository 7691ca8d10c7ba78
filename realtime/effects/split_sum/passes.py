"""The filtered cubes and the table."""

from typing import Any

from ...environments.fill import fill
from ...environments.lobes import diffuse_cube, specular_cube
from ...environments.moments import moments
from ...environments.passes import BakedPasses
from ...environments.source import environment_source
from ...shaders import source
from ..spherical_harmonics import band_weights
from . import IRRADIANCE_SIDE, levels


class Passes(BakedPasses):
    """What the two sums are, apart."""

    def bake(self) -> dict[str, Any]:
        """The cube of radiance, the table, and the irradiance as coefficients or a cube."""
        samples, filtered = int(self.knobs["samples"]), bool(self.knobs["filtered"])
        around = environment_source(self.device, self.environment)
        side = int(self.knobs["size"])
        found = {
            "radiance_atlas": specular_cube(self.device, around, side, levels(self.knobs), samples, filtered),
            "albedo_table": self._table(int(self.knobs["lut"]), samples),
        }
        if self.knobs["diffuse"] == "cube":
            cube = diffuse_cube(self.device, around, IRRADIANCE_SIDE, samples, filtered)
            return found | {"irradiance_atlas": cube}
        weights = band_weights(3, "none")
        return found | {"sh_coefficients": moments(self.device, self.environment, "sh_irradiance.glsl", weights)}

    def _table(self, side: int, samples: int):
        shader = source("table.frag", {"SAMPLES": samples, "SIDE": side}, self.folder)
        table = fill(self.device, shader, (side, side), {}, {})
        table.filter = (self.device.gl.LINEAR, self.device.gl.LINEAR)
        table.repeat_x = table.repeat_y = False
        return table
