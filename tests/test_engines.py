"""The example engines, on scenes whose answer is known: `pytest -m slow tests/test_engines.py` after what their READMEs
install. An engine that is not there is skipped with the reason. LIGHTMETER_BPY_PYTHON names a Python that has bpy."""

import importlib.util
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import OpenEXR
import pytest

from lightmeter.candidates.side_file import SideFile, read_side_file
from lightmeter.cli import main
from lightmeter.exporting import export
from lightmeter.reports.results_json import from_json
from lightmeter.scenes import shapes
from lightmeter.scenes.framing import look_at
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Camera, DirectionalLight, Material, PointLight, Scene, Shape

EXAMPLES = Path(__file__).parent.parent / "examples"
SIZE = (160, 120)
"""Not square, so that an aspect that is lost shows."""
HALF_FLOAT = 2.0**-11
"""Half the distance of neighbouring half floats, relative: nothing that engines keep on the way is coarser."""

pytestmark = pytest.mark.slow


def _lacks_vtk() -> str:
    return "" if importlib.util.find_spec("vtk") else "no vtk: pip install -r examples/vtk/requirements.txt"


def _lacks_three() -> str:
    if not any(map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))):
        return "no Chromium: apt-get install chromium"
    there = (EXAMPLES / "three.js" / "node_modules" / "three").is_dir()
    return "" if there else "no three.js: npm install in examples/three.js"


ENGINES: dict[str, Callable[[], str]] = {"vtk": _lacks_vtk, "three.js": _lacks_three}


@pytest.fixture(params=ENGINES, scope="module")
def engine(request) -> str:
    """The name of an example that can be run here."""
    lacking = ENGINES[request.param]()
    if lacking:
        pytest.skip(lacking)
    return request.param


@dataclass(frozen=True, eq=False)
class Drawn:
    """What an engine made of a scene.

    Attributes:
        image: (H, W, 3).
        depth: (H, W) metres, where the engine gives it.
        eye, rays: where the camera is, (3,), and the way each pixel's centre looks, (H, W, 3), 1 long along its axis.
    """

    image: np.ndarray
    depth: np.ndarray | None
    side: SideFile
    eye: np.ndarray
    rays: np.ndarray


def draw(engine: str, scene: Scene, folder: Path, python: str = sys.executable) -> Drawn:
    """Export the scene and run the engine's script on it, as a user would."""
    exported, out = export(scene, SIZE, folder / "scene"), folder / "out.exr"
    words = [python, EXAMPLES / engine / "render.py", exported.gltf, exported.camera, *map(str, SIZE), out]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    with OpenEXR.File(str(out), separate_channels=True) as file:
        channels = {name: channel.pixels for name, channel in file.channels().items()}
    camera = json.loads(exported.camera.read_text())["camera"]
    return Drawn(
        np.stack([channels[name] for name in "RGB"], axis=-1),
        channels.get("depth.Z"),
        read_side_file(out.with_suffix(".json")),
        np.array(camera["position"]),
        _rays(camera),
    )


def _rays(camera: dict) -> np.ndarray:
    """From the matrices of camera.json, by its conventions."""
    width, height = SIZE
    row, column = np.mgrid[:height, :width]
    clip = np.stack([2 * (column + 0.5) / width - 1, 1 - 2 * (row + 0.5) / height, 0 * row, 0 * row + 1], axis=-1)
    inside = clip @ np.linalg.inv(camera["clip_from_camera"]).T
    seen = inside[..., :3] / -inside[..., 2:3]
    return seen @ np.array(camera["world_from_camera"])[:3, :3].T


COLOURS = ((0.8, 0.2, 0.1), (0.1, 0.7, 0.3), (0.2, 0.3, 0.9), (0.5, 0.5, 0.5))
SUN = DirectionalLight("sun", (0.36, -0.48, -0.8), (3.0, 2.0, 1.0))
LAMP = PointLight("lamp", (-0.6, 0.5, 1.2), (5.0, 6.0, 7.0))


def tiles(light: DirectionalLight | PointLight) -> Scene:
    """Four diffuse tiles of different colours make up a wall in z = 0: no two parts of the picture are the same."""
    made = []
    for index, colour in enumerate(COLOURS):
        place = np.eye(4)
        place[:2, 3] = 4 * (index % 2) - 2, 2 - 4 * (index // 2)
        material = Material(f"tile {index}", colour, roughness=1.0, specular=0.0)
        made.append(Shape(f"tile {index}", shapes.rectangle(4.0, 4.0), material, place))
    camera = Camera("camera", look_at((0.5, 0.3, 3.0), (0.1, -0.1, 0.0)), yfov=0.8, near=0.5, far=20.0)
    return Scene("tiles", tuple(made), camera, (light,))


def reflected(drawn: Drawn, light: DirectionalLight | PointLight) -> np.ndarray:
    """The tiles' radiance where each pixel's centre looks: ρ/π · E · cos θ."""
    points = drawn.eye - drawn.rays * (drawn.eye[2] / drawn.rays[..., 2:])
    colours = np.array(COLOURS)[(points[..., 0] > 0) + 2 * (points[..., 1] < 0)]
    if isinstance(light, DirectionalLight):
        arriving = -light.direction[2] * np.array(light.irradiance)
    else:
        towards = np.array(light.position) - points
        distance = np.linalg.norm(towards, axis=-1, keepdims=True)
        arriving = towards[..., 2:] / distance**3 * light.intensity
    return colours / np.pi * arriving


@pytest.mark.parametrize("light", [SUN, LAMP], ids=["sun", "lamp"])
def test_diffuse_tiles_have_their_closed_form(engine, light, tmp_path):
    """Units, colours, rows and columns: any factor, swap or flip is off by far more than a half float's rounding."""
    drawn = draw(engine, tiles(light), tmp_path)
    np.testing.assert_allclose(drawn.image, reflected(drawn, light), rtol=HALF_FLOAT)
    np.testing.assert_allclose(drawn.depth, _depth_of_the_wall(drawn, 0.0), rtol=HALF_FLOAT)


def test_cycles_has_the_closed_form_of_diffuse_tiles(tmp_path):
    """Cycles averages over a pixel's square. Under a sun a tile is even: only pixels on an edge between tiles differ.
    There are two edges, and a line crosses fewer pixels than the picture has rows and columns."""
    python = os.environ.get("LIGHTMETER_BPY_PYTHON")
    if not python:
        pytest.skip("no bpy: LIGHTMETER_BPY_PYTHON names no Python that has it (examples/cycles/README.md)")
    drawn = draw("cycles", tiles(SUN), tmp_path, python)
    apart = ~np.isclose(drawn.image, reflected(drawn, SUN), rtol=HALF_FLOAT).all(axis=-1)
    assert apart.sum() < 2 * sum(SIZE)
    assert drawn.side.time is not None and drawn.side.engine.startswith("Cycles")


def _depth_of_the_wall(drawn: Drawn, z: float) -> np.ndarray:
    return (z - drawn.eye[2]) / drawn.rays[..., 2]


@pytest.fixture(scope="module")
def grid(engine, tmp_path_factory) -> tuple[Scene, Drawn]:
    """grid-sun, and what the engine made of it."""
    scene = load("grid-sun")
    return scene, draw(engine, scene, tmp_path_factory.mktemp("grid"))


def test_the_side_file_holds_times_and_a_linear_image(engine, grid):
    _, drawn = grid
    side = drawn.side
    assert engine.lower() in side.engine.lower()
    assert side.device
    assert (side.transfer, side.exposure) == ("linear", 0)
    assert side.time is not None and side.time.median > 0 and side.time.frames >= 20
    assert not side.unsupported.materials


def test_a_grid_of_spheres_throws_its_shadows_where_they_belong(grid):
    """Every part of the wall that is lit for sure is brighter, in every channel, than any that is in shadow for sure.

    Sure is what lies 0.1 m from a shadow's edge. The maps hold the wall, at most 17 m across, in 1024 texels of 1.7 cm;
    three.js looks up to 2.4 texels aside, 4.1 cm, from as far before the wall, which shifts the shadow by 3 cm.
    """
    scene, drawn = grid
    assert np.isfinite(drawn.image).all()
    spheres = np.array([shape.matrix[:3, 3] for shape in scene.shapes if shape.name != "wall"])
    [wall] = [shape.matrix[2, 3] for shape in scene.shapes if shape.name == "wall"]
    points = drawn.eye + drawn.rays * _depth_of_the_wall(drawn, wall)[..., None]
    hidden = _distances(spheres, drawn.eye, drawn.rays).min(axis=-1) < 0.31
    np.testing.assert_allclose(drawn.depth[~hidden], _depth_of_the_wall(drawn, wall)[~hidden], rtol=HALF_FLOAT)
    [sun] = scene.lights
    nearest = _distances(spheres, points, np.array(sun.direction)).min(axis=-1)
    lit, dark = (drawn.image[~hidden & where] for where in (nearest > 0.4, nearest < 0.2))
    assert len(lit) > 1000 and len(dark) > 500
    assert (dark.max(axis=0) < lit.min(axis=0)).all()


def _distances(centres: np.ndarray, origins: np.ndarray, directions: np.ndarray) -> np.ndarray:
    """(…, N) metres between N centres and lines."""
    unit = directions / np.linalg.norm(directions, axis=-1, keepdims=True)
    return np.linalg.norm(np.cross(centres - np.asarray(origins)[..., None, :], unit[..., None, :]), axis=-1)


def test_the_whole_path_from_the_command_line(engine, tmp_path, monkeypatch):
    """`lightmeter compare` gives the engine the scene, registers its frame without a complaint, and measures it.

    VTK and three.js shade nearly as we do, but for what fills shadows: the means are within a fifth of each other. A
    factor of π, or an exponent of 1/2.2, is not.
    """
    monkeypatch.setenv("LIGHTMETER_STORE", str(tmp_path / "store"))
    script = EXAMPLES / engine / "render.py"
    command = f"{engine}={sys.executable} {script} {{gltf}} {{camera_json}} {{w}} {{h}} {{exr}}"
    words = ["compare", "grid-sun", "--size", "160x120", "--spp", "16", "--no-shares", "-o", str(tmp_path / "out")]
    assert main([*words, "--candidate-command", command]) == 0
    results = from_json((tmp_path / "out" / "results.json").read_text())
    _, theirs = results.candidates
    assert theirs.name == engine
    assert theirs.findings == ()
    assert theirs.nonfinite == 0
    assert not theirs.time_whole and theirs.time_ms is not None and theirs.time_ms.frames >= 20
    assert abs(theirs.metrics["relative_bias"].value) < 0.2
    assert {layer.layer for layer in theirs.layers} >= {"depth"}
    [depth] = [layer for layer in theirs.layers if layer.layer == "depth"]
    # Silhouettes fall to either side in a pixel in a hundred; all else is the same surface.
    assert depth.metrics["p50"].value < 1e-3
