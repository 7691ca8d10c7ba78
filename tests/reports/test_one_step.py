"""What is written in one step: whole, or not at all."""

import errno
import os

import pytest

from lightmeter.reports.one_step import in_one_step, write_text


def test_a_file_is_replaced_in_a_folder_that_is_made(tmp_path):
    path = tmp_path / "new" / "deep" / "a.json"
    for text in ("one", "zwölf"):
        assert write_text(path, text) == path
        assert path.read_bytes() == text.encode()
    assert list(path.parent.iterdir()) == [path]


def test_what_fails_on_the_way_leaves_the_old_file_and_nothing_else(tmp_path):
    path = write_text(tmp_path / "a.exr", "old")
    with pytest.raises(ValueError, match="half"), in_one_step(path) as partial:
        assert partial.suffix == ".exr", "some writers go by the ending"
        partial.write_text("ne")
        raise ValueError("half")
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


def test_the_file_that_is_meant_is_named_though_the_system_names_none(tmp_path):
    """As on a full disk."""
    with pytest.raises(OSError, match=r"cannot be written \(No space") as caught, in_one_step(tmp_path / "a.txt"):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    assert (caught.value.filename, caught.value.errno) == (str(tmp_path / "a.txt"), errno.ENOSPC)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_in_the_way_is_named(tmp_path):
    (tmp_path / "taken").mkdir()
    with pytest.raises(OSError, match="cannot be written") as caught:
        write_text(tmp_path / "taken", "text")
    assert caught.value.filename == str(tmp_path / "taken")
    assert [path.name for path in tmp_path.iterdir()] == ["taken"]
