"""The full-screen pass of an effect: its GLSL gives a function per term, this wraps it into a program."""

from importlib import import_module
from typing import Any

from lightmeter.scenes.terms import TERMS

from .effect import Effect, Knobs
from .graph import FACTORS, Step
from .light_bounds import Rectangle, reached
from .shaders import Source, source
from .stage import Stage
from .uniforms import Uniforms, bind, set_uniforms

VISIBILITIES = tuple(FACTORS.values())


class ShadingPass:
    """Draws one effect, for any of its steps.

    Args:
        separate: write every term to its own attachment, without its visibility, instead of adding the composition
            to the frame's radiance.
    """

    def __init__(self, stage: Stage, effect: Effect, knobs: Knobs, separate: bool = False) -> None:
        self._stage, self._effect, self._knobs, self._separate = stage, effect, knobs, separate
        self._programs: dict[tuple, Any] = {}
        self._uniforms: dict[Step, Uniforms] = {}
        self._parts: dict[Step, Rectangle | None] = {}
        self._tables = {name: stage.device.table(values) for name, values in effect.tables(knobs).items()}
        self.own: Any = None
        if (effect.folder / "passes.py").is_file():
            module = import_module(f"{__package__}.effects.{effect.name}.passes")
            self.own = module.Passes(stage, knobs, effect.folder)
            if hasattr(self.own, "bake"):
                self.own.baked = stage.baking.of(effect.name, self.own.bake)

    @property
    def has_map(self) -> bool:
        """Whether the effect draws something beforehand, for each light or for the frame."""
        return hasattr(self.own, "draw")

    @property
    def is_per_sample(self) -> bool:
        """Whether what it draws beforehand depends on where in the pixel the scene is sampled; shadow maps do not."""
        return getattr(self.own, "per_sample", False)

    def part(self, step: Step) -> Rectangle | None:
        """The part of the picture that the step can change: what its light reaches; None where that is nothing."""
        if step not in self._parts:
            scene, size = self._stage.scene, self._stage.size
            whole: Rectangle = 0, 0, *size
            self._parts[step] = (
                whole
                if step.light is None or self._stage.elsewhere is not None
                else reached(scene.camera, size, scene.all_lights[step.light])
            )
        return self._parts[step]

    def draw(self, step: Step, target: Any, buffers: dict[str, Any]) -> None:
        """Draw into the framebuffer `target`, as far as the step's light reaches.

        Args:
            buffers: the visibilities that the step reads, by term.
        """
        device = self._stage.device
        part = self.part(step)
        if part is None:
            return
        program, vertices = self._program(step)
        target.scissor = part
        target.use()
        masked = device.gl.NOTHING if self._stage.mask is None else device.gl.DEPTH_TEST
        device.gl.depth_func = "<="
        if step.writes[0] in VISIBILITIES or self._separate:
            device.gl.enable_only(masked)
        else:
            device.gl.enable_only(device.gl.BLEND | masked)
            device.gl.blend_func = device.gl.ONE, device.gl.ONE
        if step not in self._uniforms:
            self._uniforms[step] = Uniforms(program, self._values(step))
        self._uniforms[step].write()
        set_uniforms(program, self._stage.gbuffer.place)
        textures = self._stage.gbuffer.samplers
        textures |= {f"{term}_buffer": buffers[term] for term in step.reads if term in buffers}
        if self._stage.scattered is not None:
            textures["scattered_light"] = self._stage.scattered.texture
        textures |= self._tables | self._stage.gbuffer.tables
        if self.own is not None:
            textures |= self.own.textures(step.light)
        bind(program, textures)
        device.draw(vertices, 3)
        device.gl.depth_func = "<"
        target.scissor = None

    def forget_values(self) -> None:
        """Tell the shaders everything anew, as the stage's viewer has moved."""
        self._uniforms.clear()

    def _values(self, step: Step) -> dict[str, Any]:
        """What the step's shader is told; nothing of it changes from frame to frame."""
        scene = self._stage.scene
        light = None if step.light is None else scene.all_lights[step.light]
        values = dict(self._knobs) | self._effect.uniforms(scene, self._knobs, light)
        if self.own is not None:
            values |= self.own.uniforms(step.light)
        return values | {"viewer": self._stage.viewer}

    def _program(self, step: Step):
        own = dict(self._effect.defines(self._knobs))
        if self.own is not None:
            own |= self.own.defines(step.light)
        reads = () if self._separate else step.reads
        key = (step.writes, reads, tuple(own.items()))
        if key not in self._programs:
            defines = self._stage.gbuffer.defines() | {f"READS_{term.upper()}": True for term in reads} | own
            fragment = source("shade.frag", defines).text
            body = source(f"{self._effect.name}.glsl", folder=self._effect.folder).text.removeprefix("#version 410\n")
            outputs, writes = self._outputs(step.writes, reads)
            fragment = fragment.replace("EFFECT", body).replace("OUTPUTS", outputs).replace("    WRITES", writes)
            program = self._stage.device.program(Source(fragment))
            self._programs[key] = program, self._stage.device.fullscreen(program)
        return self._programs[key]

    def _outputs(self, terms: tuple[str, ...], reads: tuple[str, ...]) -> tuple[str, str]:
        """Declarations of the outputs, and the lines that fill them."""
        if self._separate or terms[0] in VISIBILITIES:
            verdict = "float(verdict)" if self._effect.verdicts else "0.0"
            declarations = [f"layout(location = {i}) out vec4 out_{term};" for i, term in enumerate(terms)]
            lines = []
            for t in terms:  # the verdict is known when the term is
                lines.append(f"    vec3 {t}_value = seen ? {t}(surface) : vec3({TERMS[t].neutral});")
                lines.append(f"    out_{t} = vec4({t}_value, {verdict});")
            return "\n".join(declarations), "\n".join(lines)
        lines = ["    vec3 sum = vec3(0.0);"]
        for term in terms:
            factor = FACTORS.get(term)
            scale = f" * texelFetch({factor}_buffer, pixel, 0).rgb" if factor in reads else ""
            lines.append(f"    sum += {term}(surface){scale};")
        lines.append("    out_radiance = vec4(seen ? sum : vec3(0.0), 0.0);")
        return "out vec4 out_radiance;", "\n".join(lines)
