"""A scene under certain conditions: what all limits on it share. Each part is made when it is first asked for."""

from collections.abc import Callable, Sequence
from functools import cached_property

import numpy as np

from lightmeter.candidates.candidate import Candidate
from lightmeter.candidates.gathering import gather
from lightmeter.candidates.judging import Judged, judge
from lightmeter.conditions import Conditions
from lightmeter.groundtruth.store import Store
from lightmeter.limit import Limit
from lightmeter.options import MIN_BATCHES, Budget
from lightmeter.realtime.device import Device
from lightmeter.realtime.display import display_transform
from lightmeter.realtime.graph import Choice, Plan
from lightmeter.realtime.renderer import Frame, Renderer
from lightmeter.regions import Region
from lightmeter.scenes.model import Scene
from lightmeter.truth import Truth

REGISTRATION_SPP = 8
"""Samples per pixel of each batch that a candidate is registered with."""


class Case:
    """One frame and its truth.

    Args:
        name: the scene as the user names it, with what sets the conditions apart from `[defaults]`; unique.
        device: shared by all cases; called when the first of them draws.
        store: where batches are kept; None: nowhere.
        candidates: the other renderers that limits may be on.
    """

    def __init__(
        self,
        name: str,
        scene: Scene,
        conditions: Conditions,
        plan: Plan,
        device: Callable[[], Device],
        store: Store | None,
        candidates: Sequence[Candidate] = (),
    ) -> None:
        self.name, self.scene, self.conditions, self.plan, self.store = name, scene, conditions, plan, store
        self.candidates = {candidate.name: candidate for candidate in candidates}
        self._device = device
        self._judged: dict[str, Judged] = {}
        self._masks: dict[Region, np.ndarray | None] = {}

    @cached_property
    def renderer(self) -> Renderer:
        """The real-time side."""
        return Renderer(self._device(), self.plan, self.conditions.size)

    @cached_property
    def frame(self) -> Frame:
        """The frame, rendered once."""
        return self.renderer.render()

    @cached_property
    def truth(self) -> Truth:
        """The exact side."""
        c = self.conditions
        return Truth(self.plan.true_scene, c.size, Budget(c.spp), c.seed, store=self.store, scattering=c.scattering)

    @cached_property
    def display(self) -> Callable[[np.ndarray], np.ndarray]:
        """The frame's display transform."""
        return display_transform(self.plan, self.frame.radiance if self.scene.camera.metering else None)

    def judged(self, candidate: str) -> Judged:
        """A candidate's frame, obtained and registered once.

        Raises:
            CandidateError: it gave none, or one that cannot be judged.
        """
        if candidate not in self._judged:
            size, spp = self.conditions.size, REGISTRATION_SPP
            handed = gather([self.candidates[candidate]], self.scene, size, self.display).handed
            batches = [self.truth.reference_batch(number, spp) for number in range(MIN_BATCHES)]
            self._judged[candidate] = judge(self.scene, self._seen, np.stack(batches), handed)[0]
        return self._judged[candidate]

    def gave(self, candidate: str) -> bool:
        """Whether a candidate that was asked gave a frame."""
        return candidate in self._judged

    @cached_property
    def _seen(self) -> np.ndarray:
        return self.renderer.capture(terms=False).points.shape

    def region(self, limit: Limit) -> np.ndarray | None:
        """(H, W) bool, where the limit's region is; None: everywhere.

        Raises:
            UsageError: no pixel is in it.
        """
        region = limit.region
        if region not in self._masks:
            seen = self._seen if region.words else np.empty((0, 0), int)
            self._masks[region] = region.mask(self.scene, seen, limit.place)
        return self._masks[region]

    def mask(self, limit: Limit) -> np.ndarray | None:
        """(H, W) bool: the limit's region, less what its candidate is not judged on; None: everywhere."""
        region = self.region(limit)
        own = None if limit.candidate is None else self.judged(limit.candidate).mask
        return own if region is None else region if own is None else region & own

    def pixels(self, limit: Limit) -> int:
        """How many pixels the limit is on."""
        mask, (width, height) = self.mask(limit), self.conditions.size
        return width * height if mask is None else int(mask.sum())


def choice_of(conditions: Conditions) -> Choice:
    """The effects that take part."""
    settings: dict[str, dict] = {}
    for effect, knob, value in conditions.settings:
        settings.setdefault(effect, {})[knob] = value
    return Choice(conditions.only, conditions.without, conditions.use, settings)
