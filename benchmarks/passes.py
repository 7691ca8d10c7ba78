"""The frame's time, pass by pass."""

from figures import Figure

from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.realtime.timing import Times
from lightmeter.scenes.load import load

SCENES = ("cornell-box", "grid-sun", "posts")
SIZE = (512, 512)
FRAMES = 40


def measure(device: Device) -> list[Figure]:
    """Every scene's frame, and its passes one by one (their sum exceeds the frame: each waits for the device)."""
    figures = []
    for name in SCENES:
        renderer = Renderer(device, compile_plan(load(name), effects()), SIZE)
        figures += _figures(name, renderer.measure(FRAMES))
    return figures


def _figures(scene: str, times: Times) -> list[Figure]:
    frame = Figure(f"{scene}, frame", times.frame.median, "ms", None, f"± {times.frame.mad:.2f}; {times.method}")
    passes = [
        Figure(f"{scene} · {name or 'G-buffer'}", t.median, "ms", None, f"± {t.mad:.2f}") for name, _, t in times.passes
    ]
    return [frame, *passes]
