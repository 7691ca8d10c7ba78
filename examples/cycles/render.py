"""Path traces what `lightmeter export` wrote with Cycles: a second opinion on the truth itself.

    python render.py SCENE.gltf CAMERA.json WIDTH HEIGHT OUT.exr [SAMPLES]

It needs bpy (Blender as a Python module), and nothing of lightmeter. It writes OUT.exr (scene-linear R, G, B) and
OUT.json beside it. README.md says where Cycles differs by definition.
"""

import json
import platform
import sys
import time
from pathlib import Path

import bpy
from lighting import add_light, surround
from materials import follow_gltf
from mathutils import Matrix

SAMPLES = 256
ENDLESS = 1024  # bounces: as good as no limit, what Russian roulette does not end before
NOTES = [
    "a path tracer: the time is one whole image's, preparation included",
    "Fresnel reflectance is exact for dielectrics, where glTF has Schlick's; its albedo dims what lies below",
]
SPOT = "spots fall off by a smoothstep of the cosine, where glTF squares it"


def load(gltf: Path) -> None:
    """The shapes and materials, by Blender's own importer, in an empty file; Blender's Z is up."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(gltf))
    for one in list(bpy.data.objects):
        if one.type in ("CAMERA", "LIGHT"):  # camera.json has them, with their units
            bpy.data.objects.remove(one)


def look(told: dict, size: tuple[int, int], z_up: Matrix) -> None:
    """The camera of camera.json."""
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "VERTICAL"
    data.clip_start, data.clip_end = told["near"], told["far"]
    if told["kind"] == "orthographic":
        data.type = "ORTHO"
        data.ortho_scale = 2 * told["ymag"]
    else:
        data.angle_y = told["yfov"]
    made = bpy.data.objects.new("camera", data)
    made.matrix_world = z_up @ Matrix(told["world_from_camera"])
    bpy.context.collection.objects.link(made)
    scene = bpy.context.scene
    scene.camera = made
    scene.render.resolution_x, scene.render.resolution_y = size
    scene.render.resolution_percentage = 100


def trace_without_bias(samples: int) -> None:
    """Everything that trades truth for less noise is off; the pixel's filter is its square."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = samples
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0.0
    cycles.light_sampling_threshold = 0.0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    for limit in ("max", "diffuse", "glossy", "transmission", "transparent_max"):
        setattr(cycles, f"{limit}_bounces", ENDLESS)


def write(out: Path) -> None:
    """Render into a float OpenEXR file, which takes no view transform."""
    render = bpy.context.scene.render
    render.filepath = str(out)
    render.use_file_extension = False
    settings = render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth, settings.exr_codec = "OPEN_EXR", "RGB", "32", "ZIP"
    bpy.ops.render.render(write_still=True)


def main(gltf: Path, camera_json: Path, width: int, height: int, out: Path, samples: int = SAMPLES) -> None:
    """Render, time, and write both files."""
    told = json.loads(camera_json.read_text(encoding="utf-8"))
    z_up = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0), (0, 0, 0, 1)))
    load(gltf)
    follow_gltf(bpy.data.materials)
    for light in told["lights"]:
        add_light(light, z_up)
    if told["environment"]:
        surround(gltf.parent / told["environment"]["file"])
    look(told["camera"], (width, height), z_up)
    trace_without_bias(samples)
    start = time.perf_counter()
    write(out)
    milliseconds = (time.perf_counter() - start) * 1e3
    side = {
        "engine": f"Cycles, Blender {bpy.app.version_string}, {samples} samples a pixel",
        "device": platform.processor() or platform.machine(),
        "exposure": 0,
        "transfer": "linear",
        "time_ms": {"median": milliseconds, "frames": 1},
        "notes": NOTES + [SPOT] * any(light["kind"] == "spot" for light in told["lights"]),
    }
    out.with_suffix(".json").write_text(json.dumps(side, indent=2), encoding="utf-8")


if __name__ == "__main__":
    main(
        Path(sys.argv[1]),
        Path(sys.argv[2]),
        int(sys.argv[3]),
        int(sys.argv[4]),
        Path(sys.argv[5]),
        *map(int, sys.argv[6:]),
    )
