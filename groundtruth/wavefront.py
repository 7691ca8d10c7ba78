"""Estimates averaged over many samples at many places, as wavefronts of bounded size.

A lane is one sample of one place. Every number that differs between runs (seed, places, samples) is opaque, so that a
kernel compiled once serves every seed, size and budget.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from lightmeter.groundtruth.variant import dr, mi

MAX_LANES = 2**22
"""Lanes of one wavefront: bounds the memory (some 100 bytes a lane)."""


ROUNDS = 8
"""Of the hash that shifts a place's numbers (Zafar, Olano and Curtis 2010, "GPU random numbers via the tiny encryption
algorithm"). With four, neighbouring places are correlated by up to 0.6, and so are a batch's pixels; with five or more
they are not."""


@dataclass
class Lanes:
    """What one wavefront works on.

    Attributes:
        place: UInt32, which place each lane belongs to.
        sampler: Mitsuba's independent sampler, seeded.
        pattern: well spread numbers for the first few dimensions, see `Pattern`.
    """

    place: object
    sampler: object
    pattern: "Pattern"


class Pattern:
    """A rank-1 sequence over a place's samples, shifted at random per place and dimension (Cranley & Patterson 1976).

    Each number is uniform and places are independent of each other, so a mean over a place's samples is unbiased; it
    is only less noisy than with independent numbers. The generators are those of Roberts' R_d sequence (2018): powers
    of the reciprocal of the root of x^(d+1) = x + 1. In whole numbers, since fractions of large products lose digits.
    """

    def __init__(self, place, sample, seed, dimensions: int):
        self.place, self.sample, self.seed = place, sample, seed
        root = 2.0
        for _ in range(64):
            root = (1 + root) ** (1 / (dimensions + 1))
        self.steps = [round(2**32 * (root ** -(d + 1) % 1)) for d in range(dimensions)]
        self.used = 0

    def next(self):
        """Float in [0, 1): the next dimension. Asking for more dimensions than were announced is an error."""
        seed = self.seed + mi.UInt32(0x9E3779B9 * (self.used + 1) % 2**32)
        shift, _ = mi.sample_tea_32(self.place, seed, ROUNDS)
        bits = shift + self.sample * mi.UInt32(self.steps[self.used])
        self.used += 1
        return mi.Float(bits >> 8) * 2.0**-24

    def next_2d(self):
        """Point2f of the next two dimensions."""
        x = self.next()
        return mi.Point2f(x, self.next())


def average(
    places: int,
    spp: int,
    seed: Sequence[int],
    estimate: Callable[[Lanes], Sequence],
    channels: int,
    dimensions: int = 0,
) -> np.ndarray:
    """The mean of `estimate` over `spp` samples at each place.

    Args:
        places: how many places.
        seed: whole numbers that name the random stream (base seed, batch, what it is for).
        estimate: gives `channels` Floats for the lanes; called for each wavefront.
        dimensions: how many dimensions of the pattern `estimate` uses.

    Returns:
        (channels, places) float32.
    """
    if spp < 1:
        raise ValueError(f"samples per place must be at least 1, got {spp}")
    total = np.zeros((channels, places))
    at_once = min(spp, max(1, MAX_LANES // max(1, places)))
    stride = max(1, min(places, MAX_LANES // at_once))
    streams = np.random.SeedSequence([int(s) & 0xFFFFFFFF for s in seed])
    # The pattern's shifts are the same for all waves of a place, the sampler's seed never is.
    shifts = int(streams.generate_state(1)[0])
    for first in range(0, places, stride):
        count = min(stride, places - first)
        for done in range(0, spp, at_once):
            samples = min(at_once, spp - done)
            wave = int(streams.spawn(1)[0].generate_state(1)[0])
            numbers = [mi.UInt32(n) for n in (samples, first, done, wave, shifts)]
            dr.make_opaque(*numbers)
            per_place, start, skipped, wave_seed, shift_seed = numbers
            lane = dr.arange(mi.UInt32, count * samples)
            local = lane // per_place
            place = start + local
            sampler = mi.load_dict({"type": "independent"})
            sampler.seed(wave_seed, count * samples)
            pattern = Pattern(place, skipped + lane - local * per_place, shift_seed, max(1, dimensions))
            values = [mi.Float(v) for v in estimate(Lanes(place, sampler, pattern))]
            dr.eval(values)  # all channels in one kernel; the sums below would trace them one after another
            for c, value in enumerate(values):
                total[c, first : first + count] += dr.block_sum(value, samples).numpy()
    return (total / spp).astype(np.float32)
