"""The exact side of a comparison: the reference's batches and the oracles, made when asked for, or recalled."""

import zlib
from collections.abc import Callable, Collection
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from weakref import WeakKeyDictionary

import numpy as np

from lightmeter.groundtruth.batches import Progress, Reference, reference, reference_in_time
from lightmeter.groundtruth.content import points_key
from lightmeter.groundtruth.recall import recall
from lightmeter.groundtruth.scattering import SINGLE
from lightmeter.groundtruth.store import Store
from lightmeter.options import Budget
from lightmeter.progress import Report, silent
from lightmeter.scenes.features import missing_terms
from lightmeter.scenes.model import AreaLight, Scene
from lightmeter.scenes.points import SurfacePoints
from lightmeter.scenes.terms import TERMS
from lightmeter.stacking import mean_samples, reshape_points

MEMORY = 1 << 30
"""Bytes of oracles' batches that are kept in memory for those who ask again."""
Ratio = tuple[np.ndarray, np.ndarray]
"""A and B of a visibility: radiance with and without its shadow, (n, H, W, 3) each."""


@dataclass(frozen=True, eq=False)
class ExactBatch:
    """One batch of every term at stacked points, each (n, H, W, 3) float32 in W/(sr·m²).

    Attributes:
        emission: the points' own.
        direct, shadowed: per light, B without and A with its shadow.
        environment, environment_shadowed: B and A; None where the scene has no environment.
        indirect: None where the scene has none.
    """

    emission: np.ndarray
    direct: dict[int, np.ndarray] = field(default_factory=dict)
    shadowed: dict[int, np.ndarray] = field(default_factory=dict)
    environment: np.ndarray | None = None
    environment_shadowed: np.ndarray | None = None
    indirect: np.ndarray | None = None

    @property
    def bytes(self) -> int:
        """What it takes in memory."""
        rest = (self.environment, self.environment_shadowed, self.indirect)
        images = (self.emission, *self.direct.values(), *self.shadowed.values(), *rest)
        return sum(image.nbytes for image in images if image is not None)

    def samples(self) -> np.ndarray:
        """(n, H, W, 3) float64: every point's radiance with every term exact."""
        total = self.emission.astype(np.float64)
        for value in (*self.shadowed.values(), self.environment_shadowed, self.indirect):
            if value is not None:
                total += value
        return total

    def composition(self) -> np.ndarray:
        """(H, W, 3) float32: the image with every term exact."""
        return mean_samples(self.samples()).astype(np.float32)


class Truth:
    """What physics would give for one scene, size, budget and seed. Mitsuba is loaded when it is first needed.

    Args:
        store: where batches and oracles are kept; None: nowhere.
        folder: a reference written by `lightmeter reference`, taken in place of rendering one.
        scattering: which truth, see `groundtruth.scattering`.
        report: told of progress.
        say: told, in a sentence, of what the user should know (a damaged file, a reference of another version).
        reference_of: whose reference is this one's too; None: it has its own.
    """

    def __init__(
        self,
        scene: Scene,
        size: tuple[int, int],
        budget: Budget,
        seed: int = 0,
        *,
        store: Store | None = None,
        folder: Path | None = None,
        scattering: str = SINGLE,
        report: Report = silent,
        say: Callable[[str], None] = lambda _message: None,
        reference_of: "Truth | None" = None,
    ) -> None:
        self.scene, self.size, self.budget, self.seed, self.store = scene, size, budget, seed, store
        self.scattering, self.missing = scattering, missing_terms(scene)
        self._folder, self._report, self._say, self._reference_of = folder, report, say, reference_of
        self._other: Truth | None = None
        self._keys: WeakKeyDictionary[SurfacePoints, str] = WeakKeyDictionary()
        self._batches: WeakKeyDictionary[SurfacePoints, dict] = WeakKeyDictionary()
        self._room = MEMORY
        self._punctual: WeakKeyDictionary[SurfacePoints, dict[int, Ratio]] = WeakKeyDictionary()

    @cached_property
    def _world(self):
        from lightmeter.groundtruth.world import World

        return World.of(self.scene, self.scattering)

    def on(self, scene: Scene) -> "Truth":
        """The oracles on another surface of the same scene, with this truth's reference.

        The last one asked for is kept: frames are measured one at a time.
        """
        if scene is self.scene:
            return self
        if self._other is None or self._other.scene is not scene:
            self._other = Truth(
                scene,
                self.size,
                self.budget,
                self.seed,
                store=self.store,
                scattering=self.scattering,
                report=self._report,
                say=self._say,
                reference_of=self,
            )
        return self._other

    @property
    def batches(self) -> int:
        """K, the number of independent batches of the reference and of every oracle."""
        return len(self.reference.batches)

    @cached_property
    def reference(self) -> Reference:
        """The reference's batches within the budget."""
        if self._reference_of is not None:
            return self._reference_of.reference

        def progress(p: Progress) -> None:
            self._report("reference", p.done, p.total)

        if self._folder is not None:
            from lightmeter.groundtruth.folder import load

            return load(self._folder, self.scene, self.size, self._say, self.scattering)
        common = {"seed": self.seed, "store": self.store, "scattering": self.scattering, "progress": progress}
        if self.budget.seconds is not None:
            return reference_in_time(self.scene, self.size, seconds=self.budget.seconds, **common)
        spp = self.budget.spp_per_batch
        return reference(self.scene, self.size, spp=spp, batches=self.budget.batches, **common)

    @cached_property
    def doubt(self) -> str:
        """Why nothing can be decided on this truth; "" where its own checks hold. Most scenes need none."""
        from lightmeter.groundtruth.offset_check import check_offset, is_far

        if not is_far(self.scene):
            return ""
        found = check_offset(self.scene, self.size, self.seed)
        return "" if found.holds else found.words

    def to_depth(self, depth: int) -> "Truth":
        """The same for paths of at most this depth: 2 is direct light, and each bounce more is one more."""
        scene = replace(self.scene, max_depth=depth)
        how = {"store": self.store, "scattering": self.scattering, "report": self._report, "say": self._say}
        return Truth(scene, self.size, self.budget, self.seed, **how)

    def reference_batch(self, batch: int, spp: int) -> np.ndarray:
        """(H, W, 3): one batch of the reference by its number, without the others."""
        from lightmeter.groundtruth.batches import one_batch

        options = {"seed": self.seed, "store": self.store, "world": lambda: self._world, "scattering": self.scattering}
        return one_batch(self.scene, self.size, spp, batch, **options)

    def seen(self, offset: np.ndarray) -> SurfacePoints:
        """(H, W): the points that rays through the pixels hit, with unfiltered parameters.

        Args:
            offset: (2,) from the pixels' centres, pixels right and down.
        """
        from lightmeter.groundtruth.primary import surface_points

        return surface_points(self._world, self.size, np.asarray(offset) + 0.5)

    def exact_material(self, points: SurfacePoints) -> SurfacePoints:
        """The same points with unfiltered parameters; the points themselves where the scene has no textures."""
        if "material" in self.missing:
            return points
        from lightmeter.groundtruth.oracles import material

        return material.evaluate(self._world, points)

    def emission_variate(self, offsets: np.ndarray, batch: int, spp: int) -> np.ndarray | float:
        """A control variate of mean 0: what is seen to emit, over the whole pixels less at the offsets given.

        Args:
            offsets: (n, 2) from the pixels' centres, pixels right and down.
            spp: samples per pixel of the mean over the pixels.

        Returns:
            (H, W, 3), or 0 where nothing is seen to emit.
        """
        if not self.scene.area_lights and self.scene.environment is None:
            return 0.0
        from lightmeter.groundtruth.primary import seen_emission

        stream = np.random.SeedSequence([self.seed, FAMILIES["emission"], batch]).generate_state(1)[0]
        everywhere = seen_emission(self._world, self.size, spp=spp, seed=int(stream))
        here = [seen_emission(self._world, self.size, offset + 0.5) for offset in offsets]
        return everywhere - np.mean(here, axis=0, dtype=np.float64)

    def ambient_occlusion(self, points: SurfacePoints, radius: float, batch: int, spp: int) -> np.ndarray:
        """(n, H, W): one batch of the share of directions that are open up to a radius, metres, at stacked points."""
        from lightmeter.groundtruth.ambient_occlusion import ambient_occlusion

        seed = self.seed + FAMILIES["ambient occlusion"]
        return ambient_occlusion(self._world, points, radius, spp=spp, seed=seed, batch=batch)

    def mirrored_hits(self, points: SurfacePoints) -> np.ndarray:
        """(2, H, W, 3): what a perfect mirror at each point would show, position and side's normal; 0: nothing."""
        from lightmeter.groundtruth.mirrored import mirrored_hits

        return mirrored_hits(self._world, points)

    def path_traced(self, spp: int, number: int) -> np.ndarray:
        """(H, W, 3): an image by the reference's path tracer, independent of the reference and of other numbers."""
        from lightmeter.groundtruth.reference import render_batch

        return render_batch(self._world, self.size, spp, self.seed, BEYOND_BATCHES + number)

    def batch(
        self,
        points: SurfacePoints,
        batch: int,
        family: str,
        spp: int,
        keep: bool = True,
        remember: bool = True,
        terms: Collection[str] = tuple(TERMS),
    ) -> ExactBatch:
        """One batch of every term at stacked points.

        Args:
            family: names the random numbers, so that different points are given independent ones.
            spp: samples per point.
            keep: whether the store keeps the oracles one by one.
            remember: whether the memory keeps what the store keeps, for those who ask again.
            terms: those that are wanted; others cost nothing, and are in the batch only if they are remembered.
        """
        there = frozenset(terms) - set(self.missing)
        known = self._batches.setdefault(points, {})
        name = family, batch, spp, there
        for (*same, terms_of), remembered in known.items():
            if same == [family, batch, spp] and there <= terms_of:
                return remembered
        found = self._make_batch(points, batch, family, spp, keep, there)
        if keep and remember and self._room >= found.bytes:
            self._room -= found.bytes
            known[name] = found
        return found

    def _make_batch(
        self, points: SurfacePoints, batch: int, family: str, spp: int, keep: bool, there: Collection[str]
    ) -> ExactBatch:
        options = {"spp": spp, "seed": self.seed + stream(family), "batch": batch, "keep": keep}
        direct, shadowed, rest = {}, {}, {}
        if there & {"direct", "visibility"}:
            for light in range(len(self.scene.all_lights)):
                shadowed[light], direct[light] = self._light(points, light, options)
        if there & {"environment", "environment_visibility"}:
            rest["environment_shadowed"], rest["environment"] = self._environment(points, options)
        if "indirect" in there:
            rest["indirect"] = self._oracle("indirect", points, **options)
        return ExactBatch(points.emission, direct, shadowed, **rest)

    def is_sampled(self, light: int) -> bool:
        """Whether a light's radiance at a point has no closed form, so that every batch is another."""
        return isinstance(self.scene.all_lights[light], AreaLight) or self.scattering != SINGLE

    def _light(self, points: SurfacePoints, light: int, options: dict) -> Ratio:
        """A and B of a light. Punctual lights have a closed form in glTF's truth: one batch is all, asked for once."""
        if self.is_sampled(light):
            return self._ratio(points, light, options)
        known = self._punctual.setdefault(points, {})
        if light not in known:
            known[light] = self._ratio(points, light, {**options, "spp": 1, "seed": 0, "batch": 0})
        return known[light]

    def _ratio(self, points: SurfacePoints, light: int, options: dict) -> Ratio:
        if "visibility" in self.missing:
            unshadowed = self._oracle("direct", points, light=light, **options)
            return unshadowed, unshadowed
        both = self._oracle("visibility", points, light=light, **options)
        return both[0], both[1]

    def _environment(self, points: SurfacePoints, options: dict) -> Ratio:
        if "environment_visibility" in self.missing:
            unoccluded = self._oracle("environment", points, **options)
            return unoccluded, unoccluded
        both = self._oracle("environment_visibility", points, **options)
        return both[0], both[1]

    def _oracle(
        self, term: str, points: SurfacePoints, *, light: int | None = None, keep: bool, **options
    ) -> np.ndarray:
        """An oracle's batch: (n, H, W, 3), or (2, n, H, W, 3) for A and B."""
        samples, height, width = points.shape.shape
        rows = reshape_points(points, (samples * height, width))
        store = self.store if keep else None
        image, _ = recall(
            store,
            term,
            self.scene,
            rows,
            lambda: self._world,
            light=light,
            key=self._key(points) if keep else "",
            scattering=self.scattering,
            **options,
        )
        return image.reshape(*image.shape[:-3], samples, height, width, 3)

    def _key(self, points: SurfacePoints) -> str:
        """The points' digest, computed once."""
        if points not in self._keys:
            self._keys[points] = points_key(points)
        return self._keys[points]


FAMILIES = {
    "frame": 0x10000,
    "exact material": 0x20000,
    "closure": 0x30000,
    "emission": 0x40000,
    "ambient occlusion": 0x50000,
}
"""What is added to the seed for sets of points; others have a number of their name, see `stream`."""


def stream(family: str) -> int:
    """What is added to the seed for a set of points."""
    return FAMILIES[family] if family in FAMILIES else zlib.crc32(family.encode()) & 0x7FFFF000


BEYOND_BATCHES = 1 << 30
"""From here on batches of the path tracer's stream are no reference's."""
