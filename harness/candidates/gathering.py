"""Gathers the candidates' frames of one scene: exports it, runs every engine, reads what they left."""

import re
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from lightmeter.candidates.candidate import FRAME, OWN, Candidate
from lightmeter.candidates.failure import CandidateError
from lightmeter.candidates.fitting import check_fit
from lightmeter.candidates.handed import Display, Handed, take
from lightmeter.candidates.obtaining import Job, check, obtain
from lightmeter.failures import UsageError
from lightmeter.progress import Report, silent
from lightmeter.realtime.discovery import effects
from lightmeter.reports.results import FailedCandidate
from lightmeter.scenes.model import Scene
from lightmeter.scenes.terms import TERMS


@dataclass(frozen=True, eq=False)
class Gathered:
    """What candidates gave."""

    handed: tuple[Handed, ...] = ()
    failed: tuple[FailedCandidate, ...] = ()


def check_all(candidates: Sequence[Candidate]) -> None:
    """What can be told before anything is rendered.

    Raises:
        UsageError: two of one name, or one that makes no sense.
    """
    names = [candidate.name for candidate in candidates]
    for name in names:
        if names.count(name) > 1:
            raise UsageError(f"two candidates are called {name!r}; name them apart, as in --candidate NAME=FILE")
        if name in {OWN, FRAME, *effects(), *TERMS}:
            raise UsageError(f"a candidate cannot be called {name!r}, which is lightmeter's own; name it otherwise")
    for candidate in candidates:
        check(candidate)


def gather(
    candidates: Sequence[Candidate],
    scene: Scene,
    size: tuple[int, int],
    display: Display,
    folder: Path | None = None,
    report: Report = silent,
) -> Gathered:
    """Every candidate's frame; one that fails does not stop the others.

    Args:
        display: our frame's display transform.
        folder: where exports, images and logs are kept; None: nowhere.

    Raises:
        CandidateError: none of them gave a frame.
    """
    handed, failed = [], []
    with _kept(folder) as place:
        make_job = _jobs(candidates, scene, size, place)
        for number, candidate in enumerate(candidates):
            report("candidates", number, len(candidates))
            try:
                files = obtain(candidate, make_job(candidate))
                taken = take(candidate, files, size, scene.camera.exposure, display)
                check_fit(taken, scene)
                handed.append(taken)
            except CandidateError as error:
                failed.append(FailedCandidate(candidate.name, str(error)))
    report("candidates", len(candidates), len(candidates))
    if failed and not handed:
        raise CandidateError("; ".join(f"candidate {one.name!r}: {one.why}" for one in failed))
    return Gathered(tuple(handed), tuple(failed))


@contextmanager
def _kept(folder: Path | None) -> Iterator[Path]:
    if folder is not None:
        yield folder
    else:
        with tempfile.TemporaryDirectory(prefix="lightmeter-") as scratch:
            yield Path(scratch)


def _jobs(
    candidates: Sequence[Candidate], scene: Scene, size: tuple[int, int], folder: Path
) -> Callable[[Candidate], Job]:
    """A job for each candidate; the scene is exported where one of them renders it."""
    environment = None
    if any(candidate.source != "file" for candidate in candidates):
        from lightmeter.exporting import export

        environment = export(scene, size, folder / "scene").environment

    def make(candidate: Candidate) -> Job:
        own = folder / (re.sub(r"[^\w.+-]+", "-", candidate.name).strip("-.") or "candidate")
        if candidate.source != "file":
            own.mkdir(parents=True, exist_ok=True)
        return Job(
            gltf=(folder / "scene" / "scene.gltf").absolute(),
            camera_json=(folder / "scene" / "camera.json").absolute(),
            environment=environment.absolute() if environment else None,
            size=size,
            image=(own / "frame.exr").absolute(),
            side_file=(own / "frame.json").absolute(),
            scene=scene.name,
        )

    return make
