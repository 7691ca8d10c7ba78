"""Candidates against the truth, side by side with our own frame and over the same pixels."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from lightmeter.candidates.candidate import OWN
from lightmeter.candidates.failure import CandidateError
from lightmeter.candidates.handed import Handed
from lightmeter.candidates.layer_names import LAYERS
from lightmeter.candidates.masking import left_out
from lightmeter.candidates.registering import register
from lightmeter.failures import UsageError
from lightmeter.hints import nearest
from lightmeter.limit import FRAME
from lightmeter.measuring import Question
from lightmeter.metrics.finite import find_non_finite
from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.registry import METRICS
from lightmeter.reports import results as outcome
from lightmeter.scenes.model import Scene
from lightmeter.sides import Sides


@dataclass(frozen=True, eq=False)
class Judged:
    """A candidate that is ready to be measured.

    Attributes:
        image: (H, W, 3) as it is measured: with what was asked for corrected.
        masked: reason to (H, W) bool, pixels that are left out for it.
        findings: what registration found.
        mask: (H, W) bool, pixels that every candidate can be judged on; None: all.
    """

    handed: Handed
    image: np.ndarray
    masked: Mapping[str, np.ndarray]
    findings: tuple[outcome.Finding, ...]
    mask: np.ndarray | None

    @property
    def name(self) -> str:
        """As reports call it."""
        return self.handed.candidate.name

    def term_of(self, layer: str) -> str:
        """The term that one of its layers approximates."""
        return LAYERS[self.handed.layers[layer][0].kind].term

    @property
    def masked_fraction(self) -> float:
        """How much of the image is not judged, 0…1."""
        return 0.0 if self.mask is None else 1.0 - float(self.mask.mean())

    @property
    def words(self) -> str:
        """What registration found, and whether it was corrected; "" where there is nothing to say."""
        return "; ".join(
            f"{one.words} ({'corrected as asked' if one.corrected else 'not corrected'})" for one in self.findings
        )

    def check(self, of: str, metric: str) -> None:
        """That a limit can be on it.

        Raises:
            CandidateError: it lacks the layer, or a display image is asked for radiance.
        """
        if of != FRAME:
            if of not in self.handed.layers:
                raise CandidateError(f"it handed in no layer {of!r}; {nearest(of, self.handed.layers)}")
        elif self.handed.display is not None and metric in METRICS and METRICS[metric].domain != "display":
            raise CandidateError(
                f"{metric} speaks of radiance, and it handed in a display image ({self.handed.transfer}); hand in a "
                "scene-linear one, or limit flip or ssim"
            )

    def question(self, names: Sequence[str], reference: Sequence[np.ndarray]) -> Question:
        """Those of the metrics that speak of its image; of a display image the display metrics."""
        linear = self.handed.display is None
        usable = tuple(name for name in names if linear or METRICS[name].domain == "display")
        sides = Sides([filled(self.image, self.mask, reference)], list(reference))
        return Question(usable, sides, bounds=True, mask=self.mask, display=self.handed.display)

    def result(
        self,
        metrics: Mapping[str, Measurement],
        layers: tuple[outcome.LayerError, ...] = (),
        attribution: outcome.Attribution | None = None,
        notes: tuple[str, ...] = (),
    ) -> outcome.Candidate:
        """What the report says of it."""
        handed = self.handed
        return outcome.Candidate(
            name=self.name,
            source=handed.candidate.source,
            metrics=metrics,
            time_ms=handed.time,
            time_how=handed.time_how,
            time_whole=handed.time_whole,
            pixels=count(self.mask, self.image),
            masked={reason: int(pixels.sum()) for reason, pixels in self.masked.items()},
            findings=self.findings,
            layers=layers,
            attribution=attribution,
            nonfinite=find_non_finite(self.image).pixels,
            engine=handed.engine,
            device=handed.device,
            notes=handed.notes + notes,
        )


def judge(scene: Scene, shapes: np.ndarray, reference: np.ndarray, handed: Sequence[Handed]) -> tuple[Judged, ...]:
    """Register every candidate, and agree on the pixels that all of them can be judged on.

    Args:
        shapes: (H, W) index into `Scene.shapes` of what each pixel's centre shows, −1 for none.
        reference: (K, H, W, 3) batches.

    Raises:
        UsageError: no pixel is left.
    """
    seen = [register(one, reference, shapes < 0) for one in handed]
    masked = [left_out(scene, shapes, one) for one in handed]
    for reasons, registered in zip(masked, seen, strict=True):
        if registered.outside.any():
            reasons["outside of the frame, once it was moved"] = registered.outside
    away = [pixels for reasons in masked for pixels in reasons.values()]
    mask = ~np.any(away, axis=0) if away else None
    if mask is not None and not mask.any():
        raise UsageError("every pixel is left out by what the candidates do not support: there is nothing to compare")
    return tuple(
        Judged(one, registered.image, reasons, registered.findings, mask)
        for one, registered, reasons in zip(handed, seen, masked, strict=True)
    )


def own_result(
    frame: np.ndarray,
    metrics: Mapping[str, Measurement],
    time: outcome.Timing | None,
    how: str,
    mask: np.ndarray | None,
) -> outcome.Candidate:
    """Our own frame as one of the engines."""
    return outcome.Candidate(
        OWN,
        OWN,
        metrics,
        time,
        how,
        pixels=count(mask, frame),
        nonfinite=find_non_finite(frame).pixels,
    )


def filled(image: np.ndarray, mask: np.ndarray | None, reference: Sequence[np.ndarray]) -> np.ndarray:
    """(H, W, 3): the image with the truth where it is not judged, so that spatial filters see no error there."""
    if mask is None:
        return image
    return np.where(mask[..., None], image, np.mean(reference, axis=0, dtype=np.float64)).astype(np.float32)


def count(mask: np.ndarray | None, image: np.ndarray) -> int:
    """How many pixels are compared."""
    return int(mask.sum()) if mask is not None else image.shape[0] * image.shape[1]
