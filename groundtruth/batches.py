"""The reference as K independent batches, from the store where they are there, else path traced.

Mitsuba is not imported as long as the store has everything.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from lightmeter.groundtruth.scattering import SINGLE, check_scattering
from lightmeter.groundtruth.store import Series, Store
from lightmeter.groundtruth.variant import choose
from lightmeter.scenes.model import Scene

LEAST = 8
"""Batches of a reference, at least (design, section 4)."""

REFERENCE = "reference"


@dataclass(frozen=True, eq=False)
class Reference:
    """The truth of one camera's image.

    Attributes:
        batches: (K, H, W, 3) float32, radiance in W/(sr·m²), row 0 at the top; independent of each other.
        spp: samples per pixel of one batch.
        seed: base seed.
        seconds: what the batches took to render, added up, whenever that was.
        reused: how many came from the store.
        nonfinite: pixels of `batches` with a value that is not finite, over all batches.
        key: of the series.
        scene_key: of the scene.
        scattering: which truth, see `scattering`.
    """

    batches: np.ndarray
    spp: int
    seed: int
    seconds: float
    reused: int
    nonfinite: int
    key: str
    scene_key: str
    scattering: str = SINGLE

    @property
    def mean(self) -> np.ndarray:
        """(H, W, 3) float32: the mean of the batches."""
        return self.batches.mean(axis=0, dtype=np.float64).astype(np.float32)


@dataclass(frozen=True)
class Progress:
    """How far a reference is: `done` batches of `total`, `reused` of them from the store."""

    done: int
    total: int
    reused: int


def series(scene: Scene, size: tuple[int, int], spp: int, seed: int = 0, scattering: str = SINGLE) -> Series:
    """The series of a scene's reference.

    Raises:
        NoRendererError: no variant of Mitsuba can run here.
    """
    return Series.of(REFERENCE, scene, size, spp, seed, scattering, variant=choose())


def batch_name(batch: int) -> str:
    """The name of a batch's file, without its ending."""
    return f"batch-{batch:04d}"


class Renderer:
    """Makes batches of a scene's reference; builds the world when the first one is asked for.

    Args:
        world: the scene's world, where the caller has one.
        scattering: which truth; the world's.
    """

    def __init__(
        self, scene: Scene, size: tuple[int, int], seed: int = 0, world: object = None, scattering: str = SINGLE
    ):
        self.scene, self.size, self.seed, self._world = scene, size, seed, world
        self.scattering = scattering

    def __call__(self, spp: int, batch: int) -> np.ndarray:
        """One batch, (H, W, 3) float32."""
        from lightmeter.groundtruth.reference import render_batch
        from lightmeter.groundtruth.world import World

        if self._world is None:
            self._world = World.of(self.scene, self.scattering)
        return render_batch(self._world, self.size, spp, self.seed, batch)


def reference(
    scene: Scene,
    size: tuple[int, int],
    *,
    spp: int = 64,
    batches: int = LEAST,
    seed: int = 0,
    store: Store | None = None,
    world: object = None,
    scattering: str = SINGLE,
    progress: Callable[[Progress], None] = lambda progress: None,
) -> Reference:
    """The reference, `batches` × `spp` samples per pixel.

    Args:
        size: (width, height).
        spp: samples per pixel of one batch.
        batches: how many, at least 2.
        store: where batches are looked for and kept; None: nowhere.
        scattering: which truth, see `scattering`.
        progress: called before the first batch and after each.

    Raises:
        ValueError: an argument is out of range.
        NoRendererError: Mitsuba cannot run here.
    """
    _check(size, spp, batches)
    check_scattering(scattering, scene)
    wanted = series(scene, size, spp, seed, scattering)
    renderer = Renderer(scene, size, seed, world, scattering)
    images, seconds, reused = [], 0.0, 0
    progress(Progress(0, batches, 0))
    for batch in range(batches):
        image, spent, known = _one(wanted, renderer, batch, store)
        images.append(image)
        seconds += spent
        reused += known
        progress(Progress(batch + 1, batches, reused))
    return collect(images, wanted, seconds, reused, scattering)


def one_batch(
    scene: Scene,
    size: tuple[int, int],
    spp: int,
    batch: int,
    *,
    seed: int = 0,
    store: Store | None = None,
    world: Callable[[], object],
    scattering: str = SINGLE,
) -> np.ndarray:
    """One batch of a scene's reference, (H, W, 3) float32, from the store where it is there.

    Args:
        batch: its number; batches of one seed are independent of each other, however many samples each has.
        world: gives the scene's `World`; called only where the store lacks the batch.

    Raises:
        NoRendererError: Mitsuba cannot run here.
    """

    def render(spp: int, batch: int) -> np.ndarray:
        return Renderer(scene, size, seed, world(), scattering)(spp, batch)

    return _one(series(scene, size, spp, seed, scattering), render, batch, store)[0]


def reference_in_time(
    scene: Scene,
    size: tuple[int, int],
    *,
    seconds: float,
    seed: int = 0,
    store: Store | None = None,
    world: object = None,
    scattering: str = SINGLE,
    progress: Callable[[Progress], None] = lambda progress: None,
) -> Reference:
    """The reference that `seconds` of rendering buy: at least 8 batches, of a power of two samples each.

    A short trial says how many samples fit; batches then follow until the time is spent. Time that stored batches
    took when they were made counts, so that asking again gives the same reference from the store. The trial's
    outcome is kept in the store for that reason.

    Raises:
        ValueError: an argument is out of range.
        NoRendererError: Mitsuba cannot run here.
    """
    if not seconds > 0:
        raise ValueError(f"seconds must be above 0, got {seconds:g}")
    _check(size, 1, LEAST)
    check_scattering(scattering, scene)
    renderer = Renderer(scene, size, seed, world, scattering)
    spp = _affordable(renderer, seconds, store)
    wanted = series(scene, size, spp, seed, scattering)
    images, spent, reused = [], 0.0, 0
    progress(Progress(0, LEAST, 0))
    while len(images) < LEAST or spent * (1 + 1 / len(images)) <= seconds:
        image, took, known = _one(wanted, renderer, len(images), store)
        images.append(image)
        spent += took
        reused += known
        expected = max(LEAST, len(images), int(seconds * len(images) / max(spent, 1e-9)))
        progress(Progress(len(images), expected, reused))
    return collect(images, wanted, spent, reused, scattering)


def collect(images: list[np.ndarray], of: Series, seconds: float, reused: int, scattering: str = SINGLE) -> Reference:
    """A reference from its batches; values that are not finite are counted."""
    stack = np.stack(images)
    nonfinite = int(np.count_nonzero(~np.isfinite(stack).all(axis=-1)))
    return Reference(stack, of.spp, of.seed, seconds, reused, nonfinite, of.key, of.scene_key, scattering)


def _one(
    wanted: Series, renderer: Callable[[int, int], np.ndarray], batch: int, store: Store | None
) -> tuple[np.ndarray, float, bool]:
    """A batch, the seconds it took when it was rendered, and whether it came from the store."""
    name = batch_name(batch)
    found = store.read(wanted, name) if store is not None else None
    if found is not None and "" in found[0]:
        return found[0][""], _seconds(found[1]), True
    start = time.perf_counter()
    image = renderer(wanted.spp, batch)
    took = round(time.perf_counter() - start, 6)  # as the file will say it
    if store is not None:
        store.write(wanted, name, {"": image}, took)
    return image, took, False


def _affordable(renderer: Renderer, seconds: float, store: Store | None) -> int:
    """The power of two samples per batch that fits 8 batches into the time."""
    told = {"image": renderer.size, "seconds": f"{seconds:g}"}
    trial = Series.of("trial", renderer.scene, (1, 1), 0, renderer.seed, renderer.scattering, **told)
    found = store.read(trial, "spp") if store is not None else None
    if found is not None:
        return int(found[0][""].ravel()[0])
    renderer(1, 2**31)  # compiles
    spp, took = 1, 0.0
    while took < min(0.2, seconds / 32) and spp < 256:
        spp *= 4 if took else 1
        start = time.perf_counter()
        renderer(spp, 2**31 + 1)
        took = time.perf_counter() - start
    fits = max(1.0, seconds / LEAST / max(took, 1e-9) * spp)
    chosen = min(4096, 2 ** int(np.log2(fits)))
    if store is not None:
        store.write(trial, "spp", {"": np.full((1, 1, 3), chosen, np.float32)}, took)
    return chosen


def _seconds(metadata: dict[str, str]) -> float:
    try:
        return float(metadata.get("seconds", "0"))
    except ValueError:
        return 0.0


def _check(size: tuple[int, int], spp: int, batches: int) -> None:
    width, height = size
    if not (1 <= width <= 16384 and 1 <= height <= 16384):
        raise ValueError(f"the image's size must be 1 to 16384 pixels each way, got {width} × {height}")
    if spp < 1:
        raise ValueError(f"samples per pixel must be at least 1, got {spp}")
    if batches < 2:
        raise ValueError(f"a reference needs at least 2 batches, got {batches}")
