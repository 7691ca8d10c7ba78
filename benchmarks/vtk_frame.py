"""Renders a scene with VTK's PBR renderer, off screen: `vtk_frame.py SCENE SIDE FRAMES STEEPNESS OUT.npz`.

A process of its own, since two OpenGL stacks in one do not mix. examples/vtk draws what `lightmeter export` writes,
with shadow maps of a given steepness, and is timed with its maps drawn every frame and with them kept.
"""

import json
import sys
import tempfile
from pathlib import Path

import numpy as np

from lightmeter.exporting import export
from lightmeter.scenes.load import load

sys.path.insert(0, str(Path(__file__).parent.parent / "examples" / "vtk"))
import render
import vtk


def main(name: str, side: int, frames: int, steepness: float, out: str) -> None:
    """Render, time, and write the linear image with its depth."""
    with tempfile.TemporaryDirectory(prefix="lightmeter-bench-") as folder:
        exported = export(load(name), (side, side), Path(folder))
        document, told = (json.loads(path.read_text(encoding="utf-8")) for path in (exported.gltf, exported.camera))
        window, lights = render.build(exported.gltf, document, told, (side, side))
    target = render.shadowed(steepness)
    window.GetRenderers().GetFirstRenderer().SetPass(target)
    drawn, kept = (render.milliseconds(window, redrawn, frames) for redrawn in (lights, []))
    radiance, depth = render.pictures(target)
    np.savez(
        out,
        radiance=radiance.astype(np.float32),
        distance=render.metres(depth, told["camera"]),
        drawn=drawn,
        kept=kept,
        version=vtk.vtkVersion.GetVTKVersion(),
    )


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), float(sys.argv[4]), sys.argv[5])
