"""Frames to hand in: our own renderer's, with its buffers as the documented layers."""

from pathlib import Path

import numpy as np

from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import compile_plan
from lightmeter.realtime.renderer import Capture, Renderer
from lightmeter.reports.image_files import write_channels
from lightmeter.scenes.load import load

AMBIENT = {"environment": "environment", "environment_visibility": "ambient_visibility", "indirect": "indirect"}


def own_renderer(scene: str, size: tuple[int, int]) -> Renderer:
    """Our renderer with its usual effects."""
    return Renderer(Device(), compile_plan(load(scene), effects()), size)


def channels(name: str, image: np.ndarray) -> dict[str, np.ndarray]:
    """The channels of a layer; "" is the unnamed one."""
    return {f"{name}.{c}" if name else c: image[..., i] for i, c in enumerate("RGB")}


def layers_of(capture: Capture) -> dict[str, np.ndarray]:
    """A capture's buffers by the documented names."""
    found = {f"direct.{light}": image for light, image in capture.direct.items()}
    found |= {f"visibility.{light}": image for light, image in capture.visibility.items()}
    found |= {AMBIENT[term]: image for term, image in capture.frame.items()}
    return found


def write_own_frame(path: Path, renderer: Renderer) -> Path:
    """Our frame with all its layers."""
    capture = renderer.capture()
    written = channels("", renderer.render().radiance)
    for name, image in layers_of(capture).items():
        written |= channels(name, image)
    written |= channels("normal", capture.points.normal) | channels("position", capture.points.position)
    camera = renderer.plan.scene.camera
    depth = (capture.points.position - camera.position) @ -camera.matrix[:3, 2]
    written["depth.Z"] = np.where(capture.points.hit, depth, 0.0).astype(np.float32)
    return write_channels(path, written)
