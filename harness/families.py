"""The composition with any set of players exact, as batches.

Terms such as `surface`, `material` and `coverage` are no buffers but variants of the G-buffer: making one exact changes
the points that every other term is evaluated at. So there is a *family* of layers per variant: at the frame's own
points, or at sub-pixel offsets of each batch's own (coverage exact); and for each set of the players that vary the
points (`variants.py`).
"""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from lightmeter.exact_batch import ExactBatch
from lightmeter.groundtruth.content import digest
from lightmeter.groundtruth.oracles import coverage
from lightmeter.groundtruth.store import Series
from lightmeter.progress import Report, silent
from lightmeter.realtime.renderer import Capture, Renderer
from lightmeter.scenes.points import SurfacePoints
from lightmeter.sides import MOST_SAMPLES, FramePoints
from lightmeter.stacking import mean_samples
from lightmeter.substitution import Slot, exact_ratios, players_of, slot_image, slots
from lightmeter.truth import FAMILIES, Truth
from lightmeter.variants import Variants

EMISSION_SPP = 32
"""Samples per pixel of the emission's control variate."""


@dataclass(frozen=True, eq=False)
class Layers:
    """Images that add up to the composition.

    Attributes:
        base: what no player changes: (K, H, W, 3), or (1, H, W, 3) where it is the same for all batches.
        images: per slot, per set of its exact players: (K or 1, H, W, 3).
    """

    slots: tuple[Slot, ...]
    base: np.ndarray
    images: tuple[tuple[np.ndarray, ...], ...]

    def parts(self, exact: Collection[str]) -> list[np.ndarray]:
        """The images, (K or 1, H, W, 3) each, whose sum is the composition with these players exact."""
        chosen = zip(self.slots, self.images, strict=True)
        return [self.base, *(images[slot.exact_set(exact)] for slot, images in chosen)]


class Families:
    """Layers by variant, each made when it is first asked for.

    Args:
        frame: (H, W, 3), the frame's radiance. Its own layers are shifted to add up to it: a frame of many samples is
            taken apart at some of them.
        at: the frame's points.
    """

    def __init__(
        self,
        renderer: Renderer,
        truth: Truth,
        frame: np.ndarray,
        at: FramePoints,
        report: Report = silent,
    ) -> None:
        self._truth, self._frame, self._report = truth, frame, report
        self._at = at
        self._slots = slots(renderer.plan)
        self._known: dict[tuple[frozenset[str], bool], Layers] = {}
        self._shift = np.zeros(1)
        self._coverage = frozenset(players_of(renderer.plan, "coverage"))

    def layers(self, exact: Collection[str]) -> Layers:
        """The layers of the variant that these players make exact."""
        variant = self._at.variants.named(exact), self._coverage <= frozenset(exact)
        if variant not in self._known:
            make = self._at_offsets if variant[1] else self._at_frame
            self._known[variant] = make(variant[0])
        return self._known[variant]

    def _at_frame(self, exact: frozenset[str]) -> Layers:
        """At the frame's own points; what needs no oracle is the same for all batches."""
        at, seen = self._at, self._at.seen(exact)
        batches = [at.batch(exact, batch, at.spp) for batch in range(self._truth.batches)]
        layers = layers_at(self._slots, seen.points, seen.captures, batches, seen.truth)
        if exact:
            self.layers(())  # whose shift is this one's too
        else:
            self._shift = self._frame - composition(layers, ())
        return replace(layers, base=layers.base + self._shift)

    def _at_offsets(self, exact: frozenset[str]) -> Layers:
        """At random sub-pixel offsets, other ones for every batch."""
        parts = list(offset_layers(self._at.variants, exact, self._slots, report=self._report))
        base, *rest = (np.stack(images) for images in zip(*parts, strict=True))
        images, start = [], 0
        for slot in self._slots:
            images.append(tuple(rest[start : start + len(slot.sets)]))
            start += len(slot.sets)
        return Layers(self._slots, base, tuple(images))


def layers_at(
    slots: tuple[Slot, ...],
    points: SurfacePoints,
    captures: Sequence[Capture],
    batches: Sequence[ExactBatch],
    truth: Truth,
) -> Layers:
    """The layers at some points; what needs no oracle is the same for all batches.

    Args:
        points: (n, H, W), of which `captures` holds what the effects gave and `batches` what is exact.
    """
    ratios = exact_ratios(batches)
    images = []
    for slot in slots:
        many = [batches if _is_noisy(slot, which, truth) else batches[:1] for which in slot.sets]
        images.append(
            tuple(
                np.stack([slot_image(slot, which, captures, batch, ratios) for batch in those])
                for which, those in zip(slot.sets, many, strict=True)
            )
        )
    return Layers(slots, mean_samples(points.emission)[None], tuple(images))


def composition(layers: Layers, exact: Collection[str]) -> np.ndarray:
    """(K or 1, H, W, 3) float64: the image with these players exact."""
    return sum(layers.parts(exact), start=np.zeros((1, 1, 1, 3)))


def _is_noisy(slot: Slot, which: int, truth: Truth) -> bool:
    """Whether a slot's image differs from batch to batch: where an exact radiance comes from a Monte Carlo oracle."""
    closed_form = slot.term == "direct" and not any(truth.is_sampled(light) for light in slot.lights)
    return bool(which & 1) and not closed_form


def offset_layers(
    variants: Variants,
    exact: Collection[str],
    slots: tuple[Slot, ...] = (),
    *,
    samples: int = MOST_SAMPLES,
    emission_spp: int = EMISSION_SPP,
    spp: int | None = None,
    report: Report = silent,
) -> Iterator[list[np.ndarray]]:
    """Batch by batch: base and, slot by slot, set by set, their images (H, W, 3) at random sub-pixel offsets.

    A fixed grid of offsets would leave a residue at silhouettes. Ratios are a batch's own, pooled over nothing: its
    points are nobody else's.

    Args:
        exact: the variant, see `Variants.named`.
        slots: what to give separately; where there are none, base is the composition with every term exact (closure).
        samples: sub-pixel offsets per batch, at most.
        emission_spp: samples per pixel of the control variate: the edge of a bright lamp holds most of what shared
            sub-pixel offsets leave uncertain, and what is seen to emit can be traced by itself.
        spp: the oracles' samples per point and offset; by default they get the reference's, shared by the offsets.
    """
    renderer, truth = variants.surface(exact)
    count, samples = truth.batches, min(truth.reference.spp, samples)
    spp = spp or max(1, truth.reference.spp // samples)
    offsets = coverage.evaluate(count, samples, seed=truth.seed + FAMILIES["closure"]) - 0.5
    # The centre's buffers stand for the rasteriser and the shaders: with others nothing stale is recalled.
    series = Series.of(
        "composition",
        truth.scene,
        truth.size,
        truth.reference.spp,
        truth.seed,
        truth.scattering,
        samples=(samples, emission_spp, spp),
        exact=sorted(exact),
        slots=[(slot.term, slot.players, slot.lights) for slot in slots],
        centre=digest(renderer.capture(terms=bool(slots))),
    )

    def make(batch: int) -> dict[str, np.ndarray]:
        seen = variants.see(exact, offsets[batch], terms=bool(slots))
        made = truth.batch(seen.points, batch, "closure", spp, keep=False)
        variate = truth.emission_variate(offsets[batch], batch, emission_spp)
        base = mean_samples(seen.points.emission) if slots else made.composition()
        ratios = exact_ratios([made]) if slots else {}
        images = [base + variate]
        images += [slot_image(slot, which, seen.captures, made, ratios) for slot in slots for which in slot.sets]
        return {f"{i:03d}": image.astype(np.float32) for i, image in enumerate(images)}

    for batch in range(count):
        report("composition", batch, count)
        if truth.store is None:
            layers = make(batch)
        else:
            layers, _ = truth.store.recall(series, f"batch-{batch:04d}", lambda b=batch: make(b))
        yield [layers[name] for name in sorted(layers)]
    report("composition", count, count)
