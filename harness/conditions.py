"""How a scene is compared."""

from dataclasses import dataclass

from lightmeter.groundtruth.scattering import SINGLE

KnobValue = bool | int | float | str


@dataclass(frozen=True)
class Conditions:
    """How a scene is compared, once for all limits that ask for the same.

    Attributes:
        size: (width, height).
        spp: samples per pixel at most.
        settings: (effect, knob, value), sorted.
        scattering: which truth, see `groundtruth.scattering`.
    """

    size: tuple[int, int]
    spp: int
    seed: int
    camera: str | int | None
    only: tuple[str, ...]
    without: tuple[str, ...]
    use: tuple[str, ...]
    settings: tuple[tuple[str, str, KnobValue], ...]
    scattering: str = SINGLE

    def beside(self, usual: "Conditions") -> str:
        """What sets these conditions apart from the usual ones, in words; "" where nothing does."""
        mine, theirs = self._words(), usual._words()
        found = [text for kind, text in mine.items() if theirs.get(kind) != text]
        return ", ".join(found + [f"not {text}" for kind, text in theirs.items() if kind not in mine])

    def _words(self) -> dict[str, str]:
        found = {f"{effect}.{knob}": f"{effect}.{knob}={value}" for effect, knob, value in self.settings}
        for name in ("only", "without", "use"):
            if value := getattr(self, name):
                found[f" {name}"] = f"{name} {' '.join(value)}"
        if self.camera is not None:
            found[" camera"] = f"camera {self.camera}"
        if self.scattering != SINGLE:
            found[" truth"] = f"truth {self.scattering}"
        found[" size"] = f"{self.size[0]}x{self.size[1]}"
        found[" spp"] = f"{self.spp} spp"
        found[" seed"] = f"seed {self.seed}"
        return found
