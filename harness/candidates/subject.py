"""A candidate as what limits are on: its frame against the reference, its layers against their oracles."""

from functools import cached_property

import numpy as np

from lightmeter.candidates.judging import Judged, filled
from lightmeter.candidates.layer_buffers import Centres, contributions
from lightmeter.cases import Case
from lightmeter.limit import FRAME, Limit
from lightmeter.measuring import Display
from lightmeter.metrics.finite import NonFinite, find_non_finite
from lightmeter.sides import Sides
from lightmeter.subjects import ImageSubject


class CandidateSubject(ImageSubject):
    """The frame of another renderer, or a layer of it."""

    def __init__(self, case: Case, candidate: str, of: str = FRAME) -> None:
        super().__init__(case)
        self._candidate, self._of = candidate, of

    @property
    def judged(self) -> Judged:
        """The candidate's frame, registered."""
        return self.case.judged(self._candidate)

    @cached_property
    def _centres(self) -> Centres:
        return Centres.of(self.case.renderer, self.case.truth)

    def draw(self, number: int, size: int) -> np.ndarray:
        """(H, W, 3) of the reference; of a layer (2, H, W, 3), the layer and its oracle."""
        spp = self.spp * size
        if self._of == FRAME:
            return self.case.truth.reference_batch(number, spp)
        exact = self._centres.batch(number, spp, (self.judged.term_of(self._of),))
        return np.stack(contributions(self.judged.handed, self._of, exact))

    def sides(self, limit: Limit) -> Sides:
        images = self.groups.images
        if self._of == FRAME:
            return Sides([filled(self.judged.image, self.case.mask(limit), images)], images)
        return Sides([both[0] for both in images], [both[1] for both in images])

    def broken(self, limit: Limit) -> NonFinite | None:
        if self._of == FRAME:
            return find_non_finite(self.judged.image, self.case.mask(limit))
        return super().broken(limit)

    def display(self, limit: Limit) -> Display:
        return self.judged.handed.display or self.case.display
