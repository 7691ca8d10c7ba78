"""Points added up in a row of bins, and the bins' mean."""

from pathlib import Path

from ...effect import Knobs
from ...fullscreen import FullscreenPass
from ...pictures.canvas import Canvas, part_of
from ...shaders import source
from ...stage import Stage
from ...uniforms import Uniforms, bind


class Passes:
    """Meters a picture.

    Attributes:
        average: a texture of one texel, the log₂ of the average luminance.
    """

    def __init__(self, stage: Stage, knobs: Knobs, folder: Path) -> None:
        device, metering = stage.device, stage.scene.camera.metering
        assert metering is not None
        self._device = device
        columns, rows = part_of(stage.size, int(knobs["stride"]))
        self._points = columns * rows
        self._bins, self._mean = Canvas(device, (int(knobs["bins"]), 1)), Canvas(device, (1, 1))
        vertex, fragment = (source(f"count.{kind}", folder=folder) for kind in ("vert", "frag"))
        self._count = device.program(fragment, vertex)
        self._vertices = device.fullscreen(self._count)
        self._values = Uniforms(self._count, {**knobs, "floor_luminance": metering.floor})
        trims = {"darkest": metering.darkest, "brightest": metering.brightest}
        self._average = FullscreenPass(device, source("average.frag", folder=folder), {**knobs, **trims})
        self.average = self._mean.texture

    def draw(self, image) -> None:
        """Of `image`, a texture."""
        gl = self._device.gl
        self._bins.framebuffer.clear()
        self._bins.framebuffer.use()
        gl.enable_only(gl.BLEND)
        gl.blend_func = gl.ONE, gl.ONE
        self._values.write()
        bind(self._count, {"image": image})
        self._device.draw(self._vertices, self._points, mode=gl.POINTS)
        self._average.draw(self._mean.framebuffer, {"counts": self._bins.texture})
