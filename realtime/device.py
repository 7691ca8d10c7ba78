"""The OpenGL context, and the one place where GL objects are made, so that they can be counted."""

from collections import Counter
from collections.abc import Iterable
from functools import cache
from typing import Any

import numpy as np

from .shaders import Source, explain

FULLSCREEN = """#version 410
void main() {
    // One triangle that covers the screen, (−1, −1), (3, −1), (−1, 3), at the greatest depth there is: a depth test
    // tells surfaces from what lies behind them all.
    vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(corner * 2.0 - 1.0, 1.0, 1.0);
}
"""


class DeviceError(RuntimeError):
    """No OpenGL context, or a shader that does not compile; the message says what to do."""


@cache
def _context():
    """The process's one context.

    moderngl frees an object when Python forgets it, in whichever context is current then. With a context per renderer
    an old one's textures would be freed by their numbers, which are a new one's.
    """
    import moderngl

    try:
        context = moderngl.create_context(standalone=True, backend="egl", require=410)
    except Exception as first:
        try:  # macOS and Windows have no EGL; their own back end is moderngl's default
            context = moderngl.create_context(standalone=True, require=410)
        except Exception:
            raise DeviceError(
                f"no OpenGL 4.1 context could be made ({first}); `lightmeter doctor` names what to install"
            ) from None
    context.gc_mode = "auto"
    return context


class Device:
    """A headless OpenGL 4.1 context, which all devices of a process share.

    Attributes:
        counts: how many "shaders", "textures" and "draws" were made so far.
        software: whether the rasteriser runs on the CPU and defers work (section 5 of the design).
    """

    def __init__(self) -> None:
        self.gl = _context()
        self.counts: Counter[str] = Counter()
        self.renderer = str(self.gl.info["GL_RENDERER"])
        self.version = str(self.gl.info["GL_VERSION"])
        self.software = any(name in self.renderer.lower() for name in ("llvmpipe", "softpipe", "swiftshader"))

    def program(self, fragment: Source, vertex: Source | None = None):
        """A linked program; without a vertex shader, one for `fullscreen`.

        Raises:
            DeviceError: where it does not compile, with the lines at fault.
        """
        import moderngl

        self.counts["shaders"] += 1
        vertex_text = vertex.text if vertex else FULLSCREEN
        try:
            return self.gl.program(vertex_shader=vertex_text, fragment_shader=fragment.text)
        except moderngl.Error as error:
            raise DeviceError(explain(str(error), fragment.text)) from None

    def target(self, size: tuple[int, int], components: int = 4, dtype: str = "f4"):
        """A texture that is drawn into and read texel by texel."""
        self.counts["textures"] += 1
        texture = self.gl.texture(size, components, dtype=dtype)
        texture.filter = (self.gl.NEAREST, self.gl.NEAREST)
        return texture

    def depth(self, size: tuple[int, int]):
        """A depth buffer that can be read as a texture, without comparison."""
        self.counts["textures"] += 1
        texture = self.gl.depth_texture(size)
        texture.compare_func = ""
        texture.filter = (self.gl.NEAREST, self.gl.NEAREST)
        texture.repeat_x = texture.repeat_y = False
        return texture

    def table(self, values: np.ndarray):
        """A texture of (H, W, 4) float32 that is interpolated linearly and held at its edges; row 0 at coordinate 0."""
        self.counts["textures"] += 1
        height, width, components = values.shape
        data = np.ascontiguousarray(values, np.float32).tobytes()
        texture = self.gl.texture((width, height), components, data, alignment=1, dtype="f4")
        texture.filter = (self.gl.LINEAR, self.gl.LINEAR)
        texture.repeat_x = texture.repeat_y = False
        return texture

    def cube(self, faces: np.ndarray):
        """A cube map of (6, side, side, 4) float32, +x −x +y −y +z −z, with mip levels, interpolated across edges."""
        self.counts["textures"] += 1
        side = faces.shape[1]
        data = np.ascontiguousarray(faces, np.float32).tobytes()
        texture = self.gl.texture_cube((side, side), 4, data, alignment=1, dtype="f4")
        texture.build_mipmaps()
        texture.filter = (self.gl.LINEAR_MIPMAP_LINEAR, self.gl.LINEAR)
        self.gl.enable_direct(0x884F)  # GL_TEXTURE_CUBE_MAP_SEAMLESS, which moderngl has no name for
        return texture

    def framebuffer(self, colors: Iterable[Any], depth: Any = None):
        """A framebuffer over existing textures."""
        return self.gl.framebuffer(list(colors), depth)

    def fullscreen(self, program):
        """A vertex array that covers the screen with one triangle."""
        return self.gl.vertex_array(program, [])

    def draw(self, vertices, count: int = -1, first: int = 0, mode: int | None = None) -> None:
        """Draw triangles, or what `mode` says."""
        self.counts["draws"] += 1
        vertices.render(self.gl.TRIANGLES if mode is None else mode, vertices=count, first=first)

    def finish(self) -> None:
        """Wait until everything drawn so far is done."""
        self.gl.finish()

    def read(self, texture) -> np.ndarray:
        """(H, W, C) of a texture, row 0 at the top."""
        # Mesa's llvmpipe draws in threads, and hands out what a texture held before the last draws where they went to a
        # framebuffer that is no longer bound. OpenGL would have it wait by itself.
        self.finish()
        dtype = {"f4": np.float32, "f1": np.uint8, "i4": np.int32, "u4": np.uint32}[texture.dtype]
        width, height = texture.size
        data = np.frombuffer(texture.read(alignment=1), dtype=dtype)
        return data.reshape(height, width, texture.components)[::-1]
