"""Whether a BRDF keeps the laws of reflection: reciprocity and conservation of energy, in float64 and on the device."""

import zlib
from dataclasses import dataclass

import numpy as np

from ..device import Device
from .both_sides import BothSides, Extreme
from .energy import Energy
from .naming import Subject
from .reciprocity import Reciprocity

RECIPROCITY, ALBEDO = "reciprocity", "albedo"
OF_THE_MODEL = 1e-6
"""A violation of reciprocity that float64 does not make: it is the model's own. Relative."""
OF_ARITHMETIC = 1e-2
"""One that is counted where float32 makes it, of what it rounds: a safe domain's 1 %."""


@dataclass(frozen=True)
class Laws:
    """What was found of a BRDF.

    Attributes:
        reciprocity: the largest violation, by the "model" and by the "device": |f(v, l) − f(l, v)| over the larger.
        albedo: the largest one; None for a factor of a BRDF.
    """

    reciprocity: dict[str, Extreme]
    albedo: Extreme | None

    @property
    def one_sided(self) -> str:
        """What is not reciprocal: the "model"; else the "inputs", whose lengths are rounded, or the "device"; or ""."""
        if self.reciprocity["model"].model > OF_THE_MODEL:
            return "model"
        worst = self.reciprocity["device"]
        if worst.device <= OF_ARITHMETIC:
            return ""
        return "inputs" if worst.given > worst.device / 2 else "device"

    @property
    def gains(self) -> str:
        """What makes energy: "model", "device" where only its arithmetic does, "" where neither."""
        if self.albedo is None:
            return ""
        most = 1 + self.albedo.error
        return "model" if self.albedo.model > most else "device" if self.albedo.device > most else ""

    def furthest(self, law: str) -> tuple[float, Extreme]:
        """How far from being kept that law is on the device, and where; the model's where only the inputs break it."""
        if law == ALBEDO:
            assert self.albedo is not None
            return self.albedo.device, self.albedo
        model, device = self.reciprocity["model"], self.reciprocity["device"]
        return (model.model, model) if self.one_sided == "inputs" else (device.device, device)


LAWS = {RECIPROCITY: Reciprocity, ALBEDO: Energy}


def law(name: str, device: Device, subject: Subject, seed: int = 0) -> Reciprocity | Energy:
    """The law of that name, of a function that declares itself a BRDF, and for the albedo a whole one."""
    return LAWS[name](BothSides(device, subject.twin, subject.folder), _rng(subject, seed))


def hold_laws(device: Device, subject: Subject, seed: int = 0) -> Laws | None:
    """What a designed set and a search find of a function; None where it declares itself no BRDF."""
    if subject.twin.brdf is None:
        return None
    sides, rng = BothSides(device, subject.twin, subject.folder), _rng(subject, seed)
    reciprocity = Reciprocity(sides, rng).worst()
    return Laws(reciprocity, Energy(sides, rng).worst() if subject.twin.brdf.whole else None)


def _rng(subject: Subject, seed: int) -> np.random.Generator:
    return np.random.default_rng((seed, zlib.crc32(f"laws of {subject.name}".encode())))
