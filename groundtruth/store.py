"""The store: batches of references and oracles on disk, found by what they are of.

A `Series` says what a set of batches is of; its key is a digest of all that, so nothing stale is ever found. A batch
is one file, written beside its place and renamed into it: a run that is killed leaves whole batches behind, and two
processes may share a store without a lock (both may make the same batch; the last one stays). A store that cannot be
written or read (a full disk, no rights) costs time and no batch: that is told once, and what it lacks is made.
"""

import os
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from lightmeter.groundtruth import batch_file, content
from lightmeter.groundtruth.batch_file import TEMPORARY, DamagedFileError
from lightmeter.groundtruth.scattering import SINGLE
from lightmeter.scenes.model import Scene

FOLDER_VARIABLE = "LIGHTMETER_STORE"
_DAY = 86400.0


def default_folder() -> Path:
    """`$LIGHTMETER_STORE`, else `lightmeter` in the user's cache folder (XDG)."""
    named = os.environ.get(FOLDER_VARIABLE)
    if named:
        return Path(named).expanduser()
    cache = os.environ.get("XDG_CACHE_HOME")
    return (Path(cache) if cache else Path.home() / ".cache") / "lightmeter"


@dataclass(frozen=True)
class Series:
    """What a set of batches is of.

    Attributes:
        kind: "reference", or an oracle's term.
        scene: the scene's name, for people; no part of the key.
        scene_key: `content.scene_key` of the scene.
        size: (width, height).
        spp: samples per pixel (or point) of one batch.
        seed: base seed.
        settings: whatever else the numbers depend on (variant, integrator, light, points …).
    """

    kind: str
    scene: str
    scene_key: str
    size: tuple[int, int]
    spp: int
    seed: int
    settings: tuple[tuple[str, str], ...] = ()

    @classmethod
    def of(
        cls,
        kind: str,
        scene: Scene,
        size: tuple[int, int],
        spp: int,
        seed: int,
        scattering: str = SINGLE,
        **settings: object,
    ) -> "Series":
        """The series of a scene, with the versions and the definition of the truth among its settings.

        Args:
            scattering: which truth; it is among the settings where it is not the usual one.
        """
        known = {"versions": content.versions(), "definition": content.definition_key()[:16]}
        if scattering != SINGLE:
            known["truth"] = scattering
        told = tuple(sorted((k, str(v)) for k, v in (known | settings).items()))
        return cls(kind, scene.name, content.scene_key(scene), (int(size[0]), int(size[1])), spp, seed, told)

    @property
    def key(self) -> str:
        """32 hex digits."""
        return content.digest(
            [self.kind, self.scene_key, self.size, self.spp, self.seed, [list(pair) for pair in self.settings]]
        )[:32]

    @property
    def metadata(self) -> dict[str, str]:
        """What goes into every batch's header."""
        return {
            "kind": self.kind,
            "scene": self.scene,
            "scene_key": self.scene_key,
            "key": self.key,
            "size": f"{self.size[0]}x{self.size[1]}",
            "spp": str(self.spp),
            "seed": str(self.seed),
            **dict(self.settings),
        }


@dataclass(frozen=True)
class Entry:
    """A series in the store.

    Attributes:
        kind, scene, size, spp, key: as in `Series`; `size` as text ("512x512").
        batches: how many files.
        bytes: their sizes' sum.
        age: seconds since a batch was last written or read.
        folder: where they are.
    """

    kind: str
    scene: str
    size: str
    spp: int
    key: str
    batches: int
    bytes: int
    age: float
    folder: Path


@dataclass
class Store:
    """Batches in a folder.

    Attributes:
        folder: `default_folder()` unless said; made when first written to.
        say: told, in one sentence, of damaged files, and once of a folder that cannot be written or read.
    """

    folder: Path = field(default_factory=default_folder)
    say: Callable[[str], None] = lambda message: None
    _told: set[str] = field(default_factory=set, repr=False, compare=False)

    def path(self, series: Series, name: str) -> Path:
        """Where a batch lies or would lie."""
        return self.folder / series.kind / series.key / f"{name}.exr"

    def read(self, series: Series, name: str) -> tuple[dict[str, np.ndarray], dict[str, str]] | None:
        """Layers and metadata of a batch; None where there is none, or a damaged one, which is told and removed."""
        path = self.path(series, name)
        try:
            found = batch_file.read(path, series.size)
        except (FileNotFoundError, NotADirectoryError):
            return None
        except DamagedFileError as error:
            self._discard(path, str(error))
            return None
        except OSError as error:
            self._tell_once("read", error, "what it holds is made again")
            return None
        if found[1].get("key") != series.key:
            self._discard(path, f"{path} belongs to another series ({found[1].get('key')})")
            return None
        _touch(path)
        return found

    def write(self, series: Series, name: str, layers: dict[str, np.ndarray], seconds: float) -> int:
        """Writes a batch; returns its size in bytes, 0 where it cannot be kept. `layers` as in `batch_file.write`."""
        metadata = series.metadata | {"name": name, "seconds": f"{seconds:.6f}"}
        try:
            return batch_file.write(self.path(series, name), layers, metadata)
        except OSError as error:
            self._tell_once("written", error, "this run goes on, and what it makes from here on may not be kept")
            return 0

    def _tell_once(self, verb: str, error: OSError, outcome: str) -> None:
        if verb in self._told:
            return
        self._told.add(verb)
        remedy = f"make room there, or name another folder in {FOLDER_VARIABLE}"
        self.say(f"the store {self.folder} cannot be {verb}: {error.strerror or error}; {outcome} ({remedy})")

    def _discard(self, path: Path, why: str) -> None:
        """Removes a file that is of no use; in a store that may only be read it stays, and is of no use again."""
        try:
            path.unlink(missing_ok=True)
        except OSError:
            self.say(f"{why}; it cannot be removed, and is made again")
            return
        self.say(f"{why}; it is removed and made again")

    def recall(
        self, series: Series, name: str, make: Callable[[], dict[str, np.ndarray]]
    ) -> tuple[dict[str, np.ndarray], bool]:
        """A batch from the store, or made and stored; and whether it was there already."""
        found = self.read(series, name)
        if found is not None:
            return found[0], True
        start = time.perf_counter()
        layers = make()
        self.write(series, name, layers, time.perf_counter() - start)
        return layers, False

    def entries(self) -> list[Entry]:
        """Every series, the largest first. A series whose files cannot be read is listed with what is known."""
        return sorted(self._entries(), key=lambda entry: -entry.bytes)

    def _entries(self) -> Iterator[Entry]:
        now = time.time()
        for folder in sorted(self.folder.glob("*/*")) if self.folder.is_dir() else []:
            files = [(path, _stat(path)) for path in folder.glob("*.exr") if not path.name.startswith(TEMPORARY)]
            files = [(path, stat) for path, stat in files if stat is not None]
            if not files:
                continue
            try:
                known = batch_file.read_metadata(files[0][0])
            except (OSError, DamagedFileError):
                known = {}
            spp = known.get("spp", "0")
            yield Entry(
                kind=folder.parent.name,
                scene=known.get("scene", "?"),
                size=known.get("size", "?"),
                spp=int(spp) if spp.isdigit() else 0,
                key=folder.name,
                batches=len(files),
                bytes=sum(stat.st_size for _, stat in files),
                age=now - max(stat.st_mtime for _, stat in files),
                folder=folder,
            )

    def prune(
        self, *, older_than: float | None = None, larger_than: int | None = None, key: str | None = None
    ) -> list[Entry]:
        """Removes series, and what killed runs left unfinished more than a day ago.

        Args:
            older_than: seconds; series that were not used for longer go.
            larger_than: bytes; the longest unused series go until the store is no larger.
            key: series whose key begins so go.

        Returns:
            What was removed. With no argument nothing but unfinished files is.
        """
        entries = sorted(self._entries(), key=lambda entry: -entry.age)
        doomed = [
            e for e in entries if (older_than is not None and e.age > older_than) or (key and e.key.startswith(key))
        ]
        if larger_than is not None:
            left = [e for e in entries if e not in doomed]
            total = sum(e.bytes for e in left)
            while left and total > larger_than:
                total -= left[0].bytes
                doomed.append(left.pop(0))
        for entry in doomed:
            _remove(entry.folder)
        for path in self.folder.glob(f"*/*/{TEMPORARY}*") if self.folder.is_dir() else []:
            stat = _stat(path)
            if stat is not None and time.time() - stat.st_mtime > _DAY:
                path.unlink(missing_ok=True)
        return doomed


def _touch(path: Path) -> None:
    """Marks a file as used; a store that may only be read stays as it is."""
    try:
        os.utime(path)
    except OSError:
        return


def _stat(path: Path) -> os.stat_result | None:
    try:
        return path.stat()
    except FileNotFoundError:  # another process removed it
        return None


def _remove(folder: Path) -> None:
    for path in folder.glob("*.exr"):
        path.unlink(missing_ok=True)
    try:
        folder.rmdir()
    except OSError:  # another process writes to it
        return
