"""Renders what `lightmeter export` wrote with three.js, in a headless Chromium.

    python render.py SCENE.gltf CAMERA.json WIDTH HEIGHT OUT.exr

It needs Chromium, three.js (`npm install` in this folder), numpy and OpenEXR, and nothing of lightmeter. It writes
OUT.exr (scene-linear R, G, B; normal and depth) and OUT.json beside it (engine, device, time, what three.js lacks).
README.md derives the units.
"""

import json
import queue
import signal
import sys
import time
from pathlib import Path
from urllib.parse import urlencode

import numpy as np
import OpenEXR
from browser import open_page
from server import serve

HERE = Path(__file__).resolve().parent
THREE = HERE / "node_modules" / "three"
PATIENCE = 540.0  # seconds; lightmeter's own default for a command is 600
NOTES = [
    "one sample a pixel, at its centre; no ambient occlusion, no light from other surfaces",
    "shadow maps of 1024 texels, filtered (PCF), drawn in every frame",
    "specular light, direct and from around, adds multiple scattering back",
]
LIGHT_NOTES = {
    "spot": "spots fall off by a smoothstep of the angle's cosine, where glTF squares it; wider than 75°: no shadow",
    "area": "emissive surfaces shine and light nothing",
}


def ask(gltf: Path, camera_json: Path, width: int, height: int) -> dict[str, bytes]:
    """What the page sends back, by path: /image and perhaps /surface, floats; /done, JSON."""
    if not THREE.is_dir():
        raise SystemExit(f"three.js is not there: run `npm install` in {HERE}")
    places = {"/": HERE, "/three/": THREE, "/export/": gltf.parent, "/camera.json": camera_json}
    with serve(places) as (address, answers):
        query = urlencode({"gltf": gltf.name, "width": width, "height": height})
        with open_page(f"{address}/page.html?{query}") as browser:
            end, got = time.monotonic() + PATIENCE, {}
            while "/done" not in got:
                try:
                    path, body = answers.get(timeout=0.2)
                except queue.Empty:
                    if browser.poll() is not None:
                        raise SystemExit(f"the browser ended with exit code {browser.returncode}") from None
                    if time.monotonic() > end:
                        raise SystemExit(f"the page did not answer within {PATIENCE:g} s") from None
                    continue
                if path == "/failed":
                    raise SystemExit(f"the page failed: {body.decode('utf-8', 'replace')}")
                got[path] = body
            return got


def cannot_show_the_sky(told: dict) -> bool:
    """three.js draws a map as a cube around the camera, which an orthographic view looks past."""
    around = told["environment"]
    return around is not None and around["radiance"] is None and told["camera"]["kind"] == "orthographic"


def pixels(body: bytes, width: int, height: int) -> np.ndarray:
    """(H, W, 4) float32, row 0 at the top; WebGL's is at the bottom."""
    return np.frombuffer(body, np.float32).reshape(height, width, 4)[::-1]


def write(out: Path, channels: dict[str, np.ndarray], side: dict) -> None:
    """The image with its layers, and the side file."""
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    planes = {name: np.ascontiguousarray(plane) for name, plane in channels.items()}
    OpenEXR.File(header, planes).write(str(out))
    out.with_suffix(".json").write_text(json.dumps(side, indent=2), encoding="utf-8")


def main(gltf: Path, camera_json: Path, width: int, height: int, out: Path) -> None:
    """Render, time, and write both files."""
    told = json.loads(camera_json.read_text(encoding="utf-8"))
    got = ask(gltf, camera_json, width, height)
    done = json.loads(got["/done"])
    times = np.array(done["times"])
    image = pixels(got["/image"], width, height)
    channels = {name: image[..., index] for index, name in enumerate("RGB")}
    if "/surface" in got:
        surface = pixels(got["/surface"], width, height)
        channels |= {name: surface[..., index] for index, name in enumerate(("normal.X", "normal.Y", "normal.Z"))}
        channels["depth.Z"] = surface[..., 3]
    kinds = {light["kind"] for light in told["lights"]}
    side = {
        "engine": f"three.js 0.{done['version']}",
        "device": done["device"],
        "exposure": 0,
        "transfer": "linear",
        "time_ms": {
            "median": float(np.median(times)),
            "mad": float(np.median(np.abs(times - np.median(times)))),
            "frames": len(times),
        },
        "unsupported": {"background": cannot_show_the_sky(told)},
        "notes": [*NOTES, *(note for kind, note in LIGHT_NOTES.items() if kind in kinds)],
    }
    write(out, channels, side)


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("ended"))  # so that the browser is ended, too
    main(Path(sys.argv[1]), Path(sys.argv[2]), int(sys.argv[3]), int(sys.argv[4]), Path(sys.argv[5]))
