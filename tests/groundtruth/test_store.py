"""The store: what is reused, what is found damaged, what a killed run leaves."""

import os
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lightmeter.groundtruth import batches, content
from lightmeter.groundtruth.batches import batch_name, reference, reference_in_time, series
from lightmeter.groundtruth.store import Series, Store, default_folder
from lightmeter.scenes.load import load
from lightmeter.scenes.model import Environment, Image, Material, PointLight, Scene, Shape, Texture

from .small_scenes import WHITE, floor, looking

SIZE = (12, 8)


def small(**changes) -> Scene:
    scene = Scene(
        "small",
        (Shape("floor", floor(), WHITE),),
        looking((0, 1, 2), (0, 0, 0), yfov=0.8),
        lights=(PointLight("lamp", (0, 2, 0), (3, 3, 3)),),
    )
    return replace(scene, **changes)


@pytest.fixture
def renders(monkeypatch):
    """Renders noise instead of light, and remembers which batches."""
    made = []

    def render(self, spp, batch):
        made.append((spp, batch))
        time.sleep(0.002)
        return np.random.default_rng([spp, batch, self.seed]).random((SIZE[1], SIZE[0], 3)).astype(np.float32)

    monkeypatch.setattr(batches.Renderer, "__call__", render)
    return made


def test_batches_come_back_from_the_store_bit_by_bit(tmp_path, renders):
    store, told = Store(tmp_path), []
    first = reference(small(), SIZE, spp=2, store=store, progress=told.append)
    assert [(p.done, p.reused) for p in told] == [(b, 0) for b in range(9)]
    assert len(renders) == 8
    again = reference(small(), SIZE, spp=2, store=store, batches=10, progress=told.append)
    assert (first.reused, again.reused) == (0, 8)
    assert renders[8:] == [(2, 8), (2, 9)]
    np.testing.assert_array_equal(first.batches, again.batches[:8])
    assert again.seconds > 0
    np.testing.assert_allclose(first.mean, first.batches.mean(axis=0), rtol=1e-6)


def test_what_the_key_depends_on():
    base = series(small(), SIZE, 2)
    lamp = PointLight("lamp", (0, 2, 0), (3, 3, 3.0001))
    texture = Texture(Image(np.zeros((2, 2, 3), np.uint8)))
    other_texture = Texture(Image(np.ones((2, 2, 3), np.uint8)))
    textured = [
        small(shapes=(Shape("floor", floor(), Material(base_color_texture=t)),)) for t in (texture, other_texture)
    ]
    different = [
        series(small(lights=(lamp,)), SIZE, 2),
        series(small(max_depth=3), SIZE, 2),
        series(small(environment=Environment((0, 0, 0))), SIZE, 2),
        series(small(shapes=(Shape("floor", floor(1.0001), WHITE),)), SIZE, 2),
        series(small(camera=looking((0, 1, 2.0001), (0, 0, 0), yfov=0.8)), SIZE, 2),
        *[series(s, SIZE, 2) for s in textured],
        series(small(), (8, 12), 2),
        series(small(), SIZE, 3),
        series(small(), SIZE, 2, seed=1),
        series(small(), SIZE, 2, scattering="multiscatter"),
    ]
    keys = {s.key for s in different}
    assert len(keys) == len(different)
    assert base.key not in keys
    brighter = replace(small().camera, exposure=2.0, near=0.5)
    same = small(name="other", summary="…", notes=("a",), camera=brighter, shapes=(Shape("x", floor(), WHITE),))
    assert series(same, SIZE, 2).key == base.key


def damage_cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:-100])


def damage_flip(path: Path) -> None:
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 4
    path.write_bytes(bytes(content))


def damage_empty(path: Path) -> None:
    path.write_bytes(b"")


@pytest.mark.parametrize("damage", [damage_cut, damage_flip, damage_empty])
def test_a_damaged_file_is_named_and_made_again(tmp_path, renders, damage, capfd):
    told = []
    store = Store(tmp_path, told.append)
    first = reference(small(), SIZE, spp=2, store=store)
    path = store.path(series(small(), SIZE, 2), batch_name(3))
    damage(path)
    again = reference(small(), SIZE, spp=2, store=store)
    assert again.reused == 7
    np.testing.assert_array_equal(first.batches, again.batches)
    assert len(told) == 1
    assert str(path) in told[0]
    assert "damaged" in told[0]
    assert reference(small(), SIZE, spp=2, store=store).reused == 8
    assert capfd.readouterr() == ("", "")


def test_a_file_of_another_series_in_the_wrong_place_is_not_taken(tmp_path, renders):
    told = []
    store = Store(tmp_path, told.append)
    reference(small(), SIZE, spp=2, store=store)
    reference(small(), SIZE, spp=4, store=store)
    wrong, right = (store.path(series(small(), SIZE, spp), batch_name(0)) for spp in (4, 2))
    right.write_bytes(wrong.read_bytes())
    assert reference(small(), SIZE, spp=2, store=store).reused == 7
    assert "another series" in told[0]


def test_values_that_are_not_finite_are_kept_and_counted(tmp_path, monkeypatch):
    def render(self, spp, batch):
        image = np.ones((SIZE[1], SIZE[0], 3), np.float32)
        if batch < 2:
            image[0, batch] = np.nan
            image[1, 0, 1] = np.inf
        return image

    monkeypatch.setattr(batches.Renderer, "__call__", render)
    store = Store(tmp_path)
    for _ in range(2):
        got = reference(small(), SIZE, spp=1, store=store)
        assert got.nonfinite == 4
        assert np.isnan(got.batches[1, 0, 1]).all()
    assert got.reused == 8


def test_a_time_budget_gives_the_same_reference_again(tmp_path, renders):
    store = Store(tmp_path)
    first = reference_in_time(small(), SIZE, seconds=0.1, store=store)
    assert len(first.batches) >= 8
    assert first.spp == 2 ** int(np.log2(first.spp))
    made = len(renders)
    again = reference_in_time(small(), SIZE, seconds=0.1, store=store)
    assert len(renders) == made
    np.testing.assert_array_equal(first.batches, again.batches)
    assert again.reused == len(again.batches)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"spp": 0}, "samples per pixel"),
        ({"batches": 1}, "at least 2 batches"),
        ({"size": (0, 4)}, "1 to 16384"),
        ({"size": (4, 20000)}, "1 to 16384"),
    ],
)
def test_arguments_out_of_range_are_refused(arguments, message):
    with pytest.raises(ValueError, match=message):
        reference(small(), arguments.pop("size", SIZE), **arguments)


def test_listing_and_pruning(tmp_path, renders):
    store = Store(tmp_path)
    for spp in (1, 2, 4):
        reference(small(), SIZE, spp=spp, store=store, batches=4)
    old = store.path(series(small(), SIZE, 1), batch_name(0)).parent
    for path in old.iterdir():
        os.utime(path, (time.time() - 5000, time.time() - 5000))
    entries = {e.spp: e for e in store.entries()}
    assert set(entries) == {1, 2, 4}
    entry = entries[1]
    assert (entry.kind, entry.scene, entry.size, entry.batches) == ("reference", "small", "12x8", 4)
    assert entry.bytes == sum(p.stat().st_size for p in old.iterdir())
    assert 4990 < entry.age < 5100
    assert store.prune() == []
    assert [e.spp for e in store.prune(older_than=1000)] == [1]
    assert not old.exists()
    assert [e.spp for e in store.prune(key=entries[4].key[:8])] == [4]
    assert [e.spp for e in store.prune(larger_than=10)] == [2]
    assert store.entries() == []


def test_unfinished_files_are_no_batches_and_go_after_a_day(tmp_path, renders):
    store = Store(tmp_path)
    reference(small(), SIZE, spp=1, store=store, batches=2)
    folder = store.path(series(small(), SIZE, 1), batch_name(0)).parent
    young, old = folder / ".unfinished-1-ab.exr", folder / ".unfinished-2-cd.exr"
    for path in (young, old):
        path.write_bytes(b"half")
    os.utime(old, (0, time.time() - 2 * 86400))
    assert store.entries()[0].batches == 2
    store.prune()
    assert young.exists()
    assert not old.exists()


def test_oracle_batches_keep_their_layers(tmp_path):
    store, calls = Store(tmp_path), []
    wanted = Series.of("visibility", small(), SIZE, 4, 0, light=1)
    layers = {name: np.random.default_rng(i).random((8, 12, 3)).astype(np.float32) for i, name in enumerate("AB")}

    def make():
        calls.append(1)
        return layers

    first, reused = store.recall(wanted, "batch-0000", make)
    again, reused_again = store.recall(wanted, "batch-0000", make)
    assert (reused, reused_again, len(calls)) == (False, True, 1)
    for name in "AB":
        np.testing.assert_array_equal(first[name], again[name])


def test_the_store_is_where_the_user_says(monkeypatch, tmp_path):
    monkeypatch.setenv("LIGHTMETER_STORE", str(tmp_path / "here"))
    assert default_folder() == tmp_path / "here"
    monkeypatch.delenv("LIGHTMETER_STORE")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert default_folder() == tmp_path / "lightmeter"
    assert Store(tmp_path / "nowhere").entries() == []


def test_what_has_no_encoding_is_refused():
    with pytest.raises(TypeError, match="canonical"):
        content.digest({"a": object()})
    assert content.digest([1, 2]) != content.digest([12])
    assert content.digest(["a", "bc"]) != content.digest(["ab", "c"])
    assert content.digest(1) != content.digest(1.0) != content.digest(True)


# With Mitsuba, in other processes.

RUN = """
import sys
from pathlib import Path
from lightmeter.groundtruth.batches import reference
from lightmeter.groundtruth.store import Store
from lightmeter.scenes.load import load
def tell(p):
    print(p.done, p.reused, flush=True)
reference(load("torus"), (48, 32), spp=64, store=Store(Path(sys.argv[1])), progress=tell)
"""


def start(folder: Path) -> subprocess.Popen:
    return subprocess.Popen([sys.executable, "-c", RUN, str(folder)], stdout=subprocess.PIPE, text=True)


def test_a_killed_run_goes_on_where_it_was_and_gives_the_same(tmp_path):
    run = start(tmp_path / "killed")
    for line in run.stdout:
        if line.startswith("3 "):
            run.send_signal(signal.SIGKILL)
            break
    run.wait()
    assert run.returncode == -signal.SIGKILL
    scene = load("torus")
    rest = reference(scene, (48, 32), spp=64, store=Store(tmp_path / "killed"))
    assert 3 <= rest.reused < 8
    undisturbed = reference(scene, (48, 32), spp=64, store=None)
    np.testing.assert_array_equal(rest.batches, undisturbed.batches)


def test_two_processes_share_a_store(tmp_path):
    runs = [start(tmp_path) for _ in range(2)]
    for run in runs:
        out, _ = run.communicate(timeout=120)
        assert run.returncode == 0
        assert out.splitlines()[-1].startswith("8 ")
    told = []
    assert reference(load("torus"), (48, 32), spp=64, store=Store(tmp_path, told.append)).reused == 8
    assert told == []
    assert not list(tmp_path.rglob(".unfinished*"))
