"""An oracle's batch from the store, or evaluated and stored."""

from collections.abc import Callable
from typing import Any

import numpy as np

from lightmeter.groundtruth import content, oracles
from lightmeter.groundtruth.scattering import SINGLE
from lightmeter.groundtruth.store import Series, Store
from lightmeter.groundtruth.variant import choose
from lightmeter.scenes.model import Scene
from lightmeter.scenes.points import SurfacePoints


def recall(
    store: Store | None,
    term: str,
    scene: Scene,
    points: SurfacePoints,
    world: Callable[[], Any],
    *,
    spp: int,
    seed: int,
    batch: int,
    light: int | None = None,
    key: str | None = None,
    scattering: str = SINGLE,
) -> tuple[np.ndarray, bool]:
    """One batch of a term that gives images.

    Args:
        points: (H, W); they are part of what the batch is found by.
        world: gives the scene's `World`; called, and Mitsuba imported, only where the store lacks the batch.
        light: index into `scene.all_lights`, for a term that is per light.
        key: `content.points_key` of the points, where the caller has it.
        scattering: which truth; the world's.
        store: None: evaluated, and kept nowhere.

    Returns:
        What the oracle's `evaluate` returns, and whether it came from the store.

    Raises:
        NoRendererError: no variant of Mitsuba can run here.
    """
    height, width = points.shape.shape
    whose = {} if light is None else {"light": light}
    arguments = () if light is None else (light,)

    def evaluate() -> np.ndarray:
        return oracles.find(term).evaluate(world(), points, *arguments, spp=spp, seed=seed, batch=batch)

    if store is None:
        return evaluate(), False
    series = Series.of(term, scene, (width, height), spp, seed, scattering, variant=choose(), **whose)
    name = f"batch-{batch:04d}-{(key or content.points_key(points))[:16]}"

    def make() -> dict[str, np.ndarray]:
        image = evaluate()
        return {"A": image[0], "B": image[1]} if image.ndim == 4 else {"": image}

    layers, reused = store.recall(series, name, make)
    return (np.stack([layers["A"], layers["B"]]) if "A" in layers else layers[""]), reused
