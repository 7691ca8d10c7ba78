"""The results of a run over stiff scenes, as `stiff.json` holds them, and the pictures beside them."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

SCHEMA = 1
SAME = 2.0**-10
"""Of the mean: a frame that changes by less is the same. Ten times float32's epsilon for a thousand operations."""
NOISY = 0.1
"""Of the mean: beyond it an error of a tenth of the mean is lost in noise. The plain scene has 4 %."""

State = Literal["finite", "refused", "not finite"]
Doubt = Literal["", "not trusted", "not converged", "black"]


@dataclass(frozen=True)
class Finding:
    """What became of a stiff scene. Every figure is over the mean of the reference, and None where it has no meaning.

    Attributes:
        error: RMS of the frame less the reference, its noise taken out.
        low, high: its 95 % interval.
        noise: RMS standard error of the reference's mean: what slow convergence looks like.
        like: the scene that it must look like; "": none.
        scale: how many times as large it is as that one.
        frame_changed: RMS of the frame less that of this scene.
        truth_changed: the same of the reference: what of it is not noise, at 95 %.
        blame: effects (or "gbuffer"), the worst first, with the share by which what they drew changed.
        lengths: knobs in metres of the effects that changed, where only the scene's size did: "gtao.radius = 0.5 m".
        words: what is not finite, refused, or not to be trusted, and why; "" where all is well.
        doubt: why nothing can be decided on the reference; "" where its own checks hold.
        black: whether the reference is.
        finite: whether both images are; True where the scene is refused.
        faults: how many pixels of both are not.
        commands: the command lines that render it again: both sides as here, and with all that a comparison says.
    """

    name: str
    what: str
    size: tuple[int, int]
    error: float | None = None
    low: float | None = None
    high: float | None = None
    noise: float | None = None
    like: str = ""
    scale: float = 1.0
    frame_changed: float | None = None
    truth_changed: float | None = None
    blame: tuple[tuple[str, float], ...] = ()
    lengths: tuple[str, ...] = ()
    words: str = ""
    doubt: str = ""
    black: bool = False
    refused: bool = False
    finite: bool = True
    faults: int = 0
    commands: tuple[str, ...] = ()
    seconds: float = 0.0


@dataclass(frozen=True)
class StiffResults:
    """Everything a run found.

    Attributes:
        schema: counts up when keys change.
        seed: of the references.
        spp, batches: samples per pixel of a batch, and how many batches a reference has.
        device: what ran it.
        scenes: in the order in which they were rendered.
    """

    schema: int
    seed: int
    spp: int
    batches: int
    device: dict[str, Any]
    scenes: Sequence[Finding]


@dataclass(frozen=True, eq=False)
class StiffPictures:
    """Both sides of a scene through the same display transform, each (H, W, 3) in 0…1; what is not finite is NaN.

    Attributes:
        error: (H, W) RMS over channels of the frame less the reference, over the reference's mean; None where that is
            not above 0.
    """

    frame: np.ndarray
    truth: np.ndarray
    error: np.ndarray | None


def state(found: Finding) -> State:
    """What became of it, in a word or two."""
    return "refused" if found.refused else "finite" if found.finite else "not finite"


def doubt(found: Finding) -> Doubt:
    """The gravest reason why its error says nothing; "" for none."""
    if found.doubt:
        return "not trusted"
    if found.black:
        return "black"
    return "not converged" if found.noise is not None and found.noise > NOISY else ""


def blamed(found: Finding) -> list[tuple[str, float]]:
    """What drew something else than for the scene that it must look like, the worst first."""
    return [(effect, share) for effect, share in found.blame if share >= SAME]
