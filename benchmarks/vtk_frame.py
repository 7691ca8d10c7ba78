"""Renders a scene with VTK's PBR renderer, off screen: `vtk_frame.py SCENE SIDE FRAMES CONSTANT OUT.npz`.

A process of its own, since two OpenGL stacks in one do not mix. It takes the scene's own triangles, normals,
materials, camera, directional lights and constant environment; docs/benchmarks.md derives the units.
"""

import os
import sys
import time
from importlib.metadata import version

os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk

from lightmeter.scenes.load import load
from lightmeter.scenes.model import Camera, DirectionalLight, Environment, Scene, Shape

SHADOW_RESOLUTION = 1024  # VTK's default, and lightmeter's
GAMMA = 2.2  # VTK's PBR shaders end in pow(colour, 1/2.2), whatever the target
WARM_UP = 5


def actor(shape: Shape) -> vtk.vtkActor:
    """The triangles and the material of a shape."""
    mesh, material = shape.world, shape.material
    data, points, cells = vtk.vtkPolyData(), vtk.vtkPoints(), vtk.vtkCellArray()
    points.SetData(numpy_to_vtk(mesh.positions, deep=True))
    cells.SetData(3, numpy_to_vtk(mesh.triangles.astype(np.int64).ravel(), deep=True, array_type=vtk.VTK_ID_TYPE))
    data.SetPoints(points)
    data.SetPolys(cells)
    if mesh.normals is not None:
        data.GetPointData().SetNormals(numpy_to_vtk(mesh.normals, deep=True))
    mapper, made = vtk.vtkPolyDataMapper(), vtk.vtkActor()
    mapper.SetInputData(data)
    made.SetMapper(mapper)
    surface = made.GetProperty()
    surface.SetInterpolationToPBR()
    surface.SetColor(*material.base_color)
    surface.SetMetallic(material.metallic)
    surface.SetRoughness(material.roughness)
    return made


def sun(light: DirectionalLight) -> vtk.vtkLight:
    """Its colour is the irradiance on a plane across it: the shader adds colour · brdf · cosine."""
    made = vtk.vtkLight()
    made.SetLightTypeToSceneLight()
    made.PositionalOff()
    made.SetFocalPoint(0, 0, 0)
    made.SetPosition(*(-np.array(light.direction)))
    made.SetColor(*light.irradiance)
    return made


def surroundings(environment: Environment) -> vtk.vtkTexture:
    """An environment map of one colour, in floats."""
    width, height = 64, 32
    image = vtk.vtkImageData()
    image.SetDimensions(width, height, 1)
    texels = np.tile(np.array(environment.radiance, np.float32), (width * height, 1))
    image.GetPointData().SetScalars(numpy_to_vtk(texels, deep=True))
    texture = vtk.vtkTexture()
    texture.SetInputData(image)
    texture.SetColorModeToDirectScalars()
    texture.MipmapOn()
    texture.InterpolateOn()
    return texture


def look(renderer: vtk.vtkRenderer, camera: Camera) -> None:
    """The scene's camera: VTK's angle of view is the vertical one, in degrees."""
    made, matrix = renderer.GetActiveCamera(), camera.matrix
    made.SetPosition(*matrix[:3, 3])
    made.SetFocalPoint(*(matrix[:3, 3] - matrix[:3, 2]))
    made.SetViewUp(*matrix[:3, 1])
    made.SetViewAngle(float(np.degrees(camera.yfov)))
    made.SetClippingRange(camera.near, camera.far)


def sequence(*passes: vtk.vtkRenderPass) -> vtk.vtkSequencePass:
    """Passes one after the other."""
    collection, made = vtk.vtkRenderPassCollection(), vtk.vtkSequencePass()
    for one in passes:
        collection.AddItem(one)
    made.SetPasses(collection)
    return made


def shadowed(constant: float) -> vtk.vtkFramebufferPass:
    """Shadow maps, then the surfaces, into float colour and depth."""
    baker, shadows, camera = vtk.vtkShadowMapBakerPass(), vtk.vtkShadowMapPass(), vtk.vtkCameraPass()
    baker.SetResolution(SHADOW_RESOLUTION)
    if constant > 0:
        baker.SetExponentialConstant(constant)
    shadows.SetShadowMapBakerPass(baker)
    camera.SetDelegatePass(sequence(baker, shadows))
    target = vtk.vtkFramebufferPass()
    target.SetDelegatePass(camera)
    target.SetColorFormat(vtk.vtkTextureObject.Float32)
    target.SetDepthFormat(vtk.vtkTextureObject.Float32)
    return target


def read(texture: vtk.vtkTextureObject) -> np.ndarray:
    """(H, W, C) float32, row 0 at the top."""
    width, height, channels = texture.GetWidth(), texture.GetHeight(), texture.GetComponents()
    out = np.zeros((height, width, channels), np.float32)
    texture.Download().Download2D(vtk.VTK_FLOAT, out, [width, height], channels, [0, 0])
    return out[::-1]


def build(scene: Scene, side: int) -> tuple[vtk.vtkRenderWindow, vtk.vtkOpenGLRenderer, list[vtk.vtkLight]]:
    """The window with everything in it, and the lights."""
    renderer, window = vtk.vtkOpenGLRenderer(), vtk.vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(side, side)
    window.AddRenderer(renderer)
    for shape in scene.shapes:
        renderer.AddActor(actor(shape))
    look(renderer, scene.camera)
    renderer.RemoveAllLights()
    renderer.AutomaticLightCreationOff()
    lights = [sun(light) for light in scene.lights]
    for light in lights:
        renderer.AddLight(light)
    renderer.UseImageBasedLightingOn()
    renderer.SetEnvironmentTexture(surroundings(scene.environment), False)
    return window, renderer, lights


def milliseconds(window: vtk.vtkRenderWindow, frames: int, redrawn: list[vtk.vtkLight]) -> np.ndarray:
    """Times of frames, each finished (glFinish); lights that are touched have their shadow map drawn again."""
    times = []
    for _ in range(WARM_UP + frames):
        for light in redrawn:
            light.Modified()
        start = time.perf_counter()
        window.Render()
        window.WaitForCompletion()
        times.append((time.perf_counter() - start) * 1e3)
    return np.array(times[WARM_UP:])


def main(name: str, side: int, frames: int, constant: float, out: str) -> None:
    """Render, time, and write the linear image with its depth."""
    scene = load(name)
    window, renderer, lights = build(scene, side)
    target = shadowed(constant)
    renderer.SetPass(target)
    window.Render()
    drawn, kept = milliseconds(window, frames, lights), milliseconds(window, frames, [])
    encoded = read(target.GetColorTexture())[..., :3].astype(np.float64)
    depth = read(target.GetDepthTexture())[..., 0]
    seen = depth < 1  # what lies behind all surfaces is not encoded
    radiance = np.where(seen[..., None], encoded**GAMMA, encoded).astype(np.float32)
    near, far = scene.camera.near, scene.camera.far
    distance = near * far / (far - depth.astype(np.float64) * (far - near))
    np.savez(out, radiance=radiance, distance=distance, drawn=drawn, kept=kept, version=version("vtk"))


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), float(sys.argv[4]), sys.argv[5])
