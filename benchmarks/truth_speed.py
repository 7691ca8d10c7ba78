"""What the truth costs: samples per second of the reference, and a batch of every oracle."""

import time
from collections.abc import Callable

import numpy as np
from figures import Figure

from lightmeter.groundtruth.recall import recall
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.graph import compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.features import missing_terms
from lightmeter.scenes.load import load
from lightmeter.scenes.model import AreaLight, Scene

SCENES = ("cornell-box", "grid-sun")
SIZE = (512, 512)
SPP = 8
RUNS = 3
PER_LIGHT = ("direct", "visibility")
PER_FRAME = ("environment", "environment_visibility", "indirect")


def measure(device: Device) -> list[Figure]:
    """Reference and oracles of every scene, a batch at a time, compiled before."""
    figures = []
    for name in SCENES:
        figures += _figures(load(name), device)
    return figures


def _figures(scene: Scene, device: Device) -> list[Figure]:
    from lightmeter.groundtruth.reference import render_batch
    from lightmeter.groundtruth.world import World

    world = World.of(scene)
    seconds = _median(lambda batch: render_batch(world, SIZE, SPP, 0, batch))
    rate = SPP / seconds
    note = (
        f"a batch of {SPP} spp in {seconds * 1e3:.0f} ms; {rate * SIZE[0] * SIZE[1] * 1e-6:.1f} million paths a second"
    )
    figures = [Figure(f"{scene.name}, reference", rate, "spp/s", None, note)]
    points = Renderer(device, compile_plan(scene, effects()), SIZE).capture(terms=False).points
    missing = missing_terms(scene)
    terms = [(term, 0) for term in PER_LIGHT if scene.all_lights] + [(term, None) for term in PER_FRAME]
    for term, light in terms:
        if term in missing:
            continue
        exact = light is not None and not isinstance(scene.all_lights[light], AreaLight)
        spp = 1 if exact else SPP
        options = {"spp": spp, "seed": 0, "light": light}
        seconds = _median(lambda b, t=term, o=options: recall(None, t, scene, points, lambda: world, batch=b, **o))
        what = term if light is None else f"{term} of {scene.all_lights[light].name}"
        figures.append(
            Figure(
                f"{scene.name} · {what}",
                seconds * 1e3,
                "ms",
                None,
                "closed form and one shadow ray" if exact else f"a batch of {spp} spp",
            )
        )
    return figures


def _median(run: Callable[[int], object]) -> float:
    """Seconds of a batch; the first compiles and does not count."""
    run(0)
    seconds = []
    for batch in range(1, RUNS + 1):
        start = time.perf_counter()
        run(batch)
        seconds.append(time.perf_counter() - start)
    return float(np.median(seconds))
