"""Renders what `lightmeter export` wrote with VTK's PBR renderer, off screen.

    python render.py SCENE.gltf CAMERA.json WIDTH HEIGHT OUT.exr

It needs vtk, numpy and OpenEXR, and nothing of lightmeter. It writes OUT.exr (scene-linear R, G, B and depth.Z) and
OUT.json beside it (engine, device, time, what VTK lacks). README.md derives the units.
"""

import json
import os
import sys
import time
from pathlib import Path

os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")  # needs no display

import numpy as np
import OpenEXR
import vtk
from gltf import import_shapes, what_vtk_lacks
from lighting import light, nothing, sky, surroundings

SHADOW_RESOLUTION = 1024  # VTK's default
STEEPEST = 88.0
"""VTK's shadow maps hold exp(c · depth), depth from 0 to 1. At the largest c whose exponential float32 can hold (88.7)
they come nearest to a comparison of depths; VTK's own c = 11 lets light through close to what throws the shadow."""
GAMMA = 2.2  # VTK's PBR shaders end in pow(colour, 1/2.2), whatever the target
GL_BLEND = 0x0BE2  # OpenGL's number for it
WARM_UP, FRAMES = 5, 20
NOTES = [
    "one sample a pixel, at its centre; no ambient occlusion, no light from other surfaces",
    f"exponential shadow maps, {SHADOW_RESOLUTION} texels, c = {STEEPEST:g}, drawn in every frame",
    "image-based lighting adds multiple scattering back; direct light's shadowing term takes roughness for its square",
]
LIGHT_NOTES = {
    "point": "point lights throw no shadows",
    "spot": "spots have a hard edge, where glTF's falloff is a half",
    "area": "emissive surfaces shine and light nothing",
}


def look(renderer: vtk.vtkRenderer, camera: dict) -> None:
    """Place the renderer's camera; VTK takes the vertical angle in degrees."""
    made = renderer.GetActiveCamera()
    position = np.array(camera["position"])
    made.SetPosition(position)
    made.SetFocalPoint(position + camera["forward"])
    made.SetViewUp(camera["up"])
    if camera["kind"] == "orthographic":
        made.ParallelProjectionOn()
        made.SetParallelScale(camera["ymag"])
    else:
        made.SetViewAngle(np.degrees(camera["yfov"]))
    made.UseExplicitAspectRatioOn()
    made.SetExplicitAspectRatio(camera["aspect"])
    made.SetClippingRange(camera["near"], camera["far"])


def mend_shadow_maps(renderer: vtk.vtkRenderer) -> None:
    """Have shadow maps drawn with the aspect that they are looked up with, and without blending.

    VTK draws them with the window's aspect and looks them up with 1. The viewer's camera, and the copies that VTK makes
    of it, state their aspect; one that does not is a light's. And it blends: where alpha is 1 but for rounding, a
    surface far behind still counts, since its exp(c · depth) is larger by many powers of ten.
    """

    def mend(*_) -> None:
        active = renderer.GetActiveCamera()
        if not active.GetUseExplicitAspectRatio():
            active.UseExplicitAspectRatioOn()
            active.SetExplicitAspectRatio(1.0)
        renderer.GetRenderWindow().GetState().vtkglDisable(GL_BLEND)

    renderer.AddObserver(vtk.vtkCommand.ActiveCameraEvent, mend)


def shadowed(steepness: float = STEEPEST) -> vtk.vtkFramebufferPass:
    """Shadow maps of that c, then the surfaces, into float colour and depth."""
    baker, shadows, camera = vtk.vtkShadowMapBakerPass(), vtk.vtkShadowMapPass(), vtk.vtkCameraPass()
    baker.SetResolution(SHADOW_RESOLUTION)
    baker.SetExponentialConstant(steepness)
    shadows.SetShadowMapBakerPass(baker)
    one_by_one, passes = vtk.vtkSequencePass(), vtk.vtkRenderPassCollection()
    passes.AddItem(baker)
    passes.AddItem(shadows)
    one_by_one.SetPasses(passes)
    camera.SetDelegatePass(one_by_one)
    target = vtk.vtkFramebufferPass()
    target.SetDelegatePass(camera)
    target.SetColorFormat(vtk.vtkTextureObject.Float32)
    target.SetDepthFormat(vtk.vtkTextureObject.Float32)
    return target


def read(texture: vtk.vtkTextureObject) -> np.ndarray:
    """(H, W, C) float32, row 0 at the top; OpenGL's is at the bottom."""
    width, height, channels = texture.GetWidth(), texture.GetHeight(), texture.GetComponents()
    out = np.zeros((height, width, channels), np.float32)
    texture.Download().Download2D(vtk.VTK_FLOAT, out, [width, height], channels, [0, 0])
    return out[::-1]


def metres(depth: np.ndarray, camera: dict) -> np.ndarray:
    """Distances along the camera's forward axis, from a depth buffer of [0, 1]; 0 where there is no surface."""
    near, far = camera["near"], camera["far"]
    if camera["kind"] == "orthographic":
        distance = near + depth * (far - near)
    else:
        distance = near * far / (far - depth * (far - near))
    return np.where(depth < 1, distance, 0)


def pictures(target: vtk.vtkFramebufferPass) -> tuple[np.ndarray, np.ndarray]:
    """What was drawn last: radiance (H, W, 3), and the depth buffer (H, W), 1 where there is no surface."""
    encoded = read(target.GetColorTexture())[..., :3].astype(np.float64)
    depth = read(target.GetDepthTexture())[..., 0].astype(np.float64)
    return np.where(depth[..., None] < 1, encoded**GAMMA, encoded), depth  # the sky is not encoded


def milliseconds(window: vtk.vtkRenderWindow, redrawn: list[vtk.vtkLight], frames: int = FRAMES) -> np.ndarray:
    """Times of finished frames (glFinish). VTK draws a shadow map again only if its light was touched."""
    times = []
    for _ in range(WARM_UP + frames):
        for one in redrawn:
            one.Modified()
        start = time.perf_counter()
        window.Render()
        window.WaitForCompletion()
        times.append((time.perf_counter() - start) * 1e3)
    return np.array(times[WARM_UP:])


def device(window: vtk.vtkRenderWindow) -> str:
    """What OpenGL calls itself."""
    lines = window.ReportCapabilities().splitlines()
    return next(line.partition(":")[2].strip() for line in lines if line.startswith("OpenGL renderer string"))


def build(gltf: Path, document: dict, told: dict, size: tuple[int, int]) -> tuple[vtk.vtkRenderWindow, list]:
    """The window with everything in it, and its lights."""
    renderer, window = vtk.vtkOpenGLRenderer(), vtk.vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(*size)
    window.AddRenderer(renderer)
    import_shapes(gltf, document, window)
    look(renderer, told["camera"])
    renderer.RemoveAllLights()
    renderer.AutomaticLightCreationOff()
    lights = [light(one) for one in told["lights"] if one["kind"] != "area"]
    for one in lights or [nothing()]:
        renderer.AddLight(one)
    mend_shadow_maps(renderer)
    if told["environment"]:
        around = surroundings(gltf.parent / told["environment"]["file"])
        renderer.UseImageBasedLightingOn()
        renderer.SetEnvironmentTexture(around, False)
        renderer.AddActor(sky(around))
    return window, lights


def write(out: Path, radiance: np.ndarray, depth: np.ndarray, side: dict) -> None:
    """The image with its depth, and the side file."""
    planes = {name: radiance[..., index] for index, name in enumerate("RGB")} | {"depth.Z": depth}
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    OpenEXR.File(header, {name: plane.astype(np.float32) for name, plane in planes.items()}).write(str(out))
    out.with_suffix(".json").write_text(json.dumps(side, indent=2), encoding="utf-8")


def main(gltf: Path, camera_json: Path, width: int, height: int, out: Path) -> None:
    """Render, time, and write both files."""
    document = json.loads(gltf.read_text(encoding="utf-8"))
    told = json.loads(camera_json.read_text(encoding="utf-8"))
    window, lights = build(gltf, document, told, (width, height))
    target = shadowed()
    window.GetRenderers().GetFirstRenderer().SetPass(target)
    times = milliseconds(window, lights)
    radiance, depth = pictures(target)
    lacking = what_vtk_lacks(document)
    side = {
        "engine": f"VTK {vtk.vtkVersion.GetVTKVersion()}",
        "device": device(window),
        "exposure": 0,
        "transfer": "linear",
        "time_ms": {
            "median": float(np.median(times)),
            "mad": float(np.median(np.abs(times - np.median(times)))),
            "frames": len(times),
        },
        "unsupported": {"materials": list(lacking)},
        "notes": [
            *NOTES,
            *(LIGHT_NOTES[kind] for kind in sorted({one["kind"] for one in told["lights"]} & set(LIGHT_NOTES))),
            *(f"{name}: {why}" for name, why in lacking.items()),
        ],
    }
    write(out, radiance, metres(depth, told["camera"]), side)


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4]), Path(sys.argv[5]))
