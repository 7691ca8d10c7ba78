"""One batch of the exact side of a comparison: every term at the same points."""

from dataclasses import dataclass, field

import numpy as np

from lightmeter.stacking import mean_samples


@dataclass(frozen=True, eq=False)
class ExactBatch:
    """One batch of every term at stacked points, each (n, H, W, 3) float32 in W/(sr·m²).

    Attributes:
        emission: the points' own.
        direct, shadowed: per light, B without and A with its shadow.
        environment, environment_shadowed: B and A; None where the scene has no environment.
        indirect: None where the scene has none.
        transmission: likewise.
    """

    emission: np.ndarray
    direct: dict[int, np.ndarray] = field(default_factory=dict)
    shadowed: dict[int, np.ndarray] = field(default_factory=dict)
    environment: np.ndarray | None = None
    environment_shadowed: np.ndarray | None = None
    indirect: np.ndarray | None = None
    transmission: np.ndarray | None = None

    @property
    def bytes(self) -> int:
        """What it takes in memory."""
        rest = (self.environment, self.environment_shadowed, self.indirect, self.transmission)
        images = (self.emission, *self.direct.values(), *self.shadowed.values(), *rest)
        return sum(image.nbytes for image in images if image is not None)

    def samples(self) -> np.ndarray:
        """(n, H, W, 3) float64: every point's radiance with every term exact."""
        total = self.emission.astype(np.float64)
        for value in (*self.shadowed.values(), self.environment_shadowed, self.indirect, self.transmission):
            if value is not None:
                total += value
        return total

    def composition(self) -> np.ndarray:
        """(H, W, 3) float32: the image with every term exact."""
        return mean_samples(self.samples()).astype(np.float32)
