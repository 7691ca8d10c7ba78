"""Candidates as the command line and lightmeter.toml name them."""

import argparse

import numpy as np
import pytest

from lightmeter.candidates import words
from lightmeter.candidates.obtaining import Job, obtain
from lightmeter.cli import Parser
from lightmeter.failures import UsageError
from lightmeter.reports.image_files import write_exr


def parsed(*texts: str) -> argparse.Namespace:
    parser = Parser()
    words.add_candidates(parser)
    return parser.parse_args(list(texts))


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_exr("frame.exr", np.ones((2, 2, 3), np.float32))
    (tmp_path / "lightmeter.toml").write_text(
        '[[candidate]]\nname = "our engine"\ncommand = "engine {exr}"\ntimeout = 7\nenvironment = { GPU = "0" }\n'
        'register = ["exposure"]\n[candidate.unsupported]\nmaterials = ["glass"]\n'
    )


def test_names_are_given_or_found():
    (a, b, c, d) = words.candidates(
        parsed(
            "--candidate", "frame.exr", "--candidate", "theirs=frame.exr",
            "--candidate-command", "python examples/vtk/render.py {exr}", "--candidate-command", "E 2=engine {exr}",
        )
    )  # fmt: skip
    assert [one.name for one in (a, b, c, d)] == ["frame.exr", "theirs", "vtk", "E 2"]
    assert (b.text, d.text) == ("frame.exr", "engine {exr}")


def test_a_described_candidate_is_taken_by_its_name():
    (one,) = words.candidates(parsed("--candidate", "our engine", "--no-background"))
    assert (one.source, one.text, one.timeout, one.environment) == ("command", "engine {exr}", 7, (("GPU", "0"),))
    assert one.register == ("exposure",)
    assert one.unsupported.materials == ("glass",)
    assert one.unsupported.background


@pytest.mark.parametrize(
    ("texts", "said"),
    [
        (("--candidate", "our engin"), "did you mean 'our engine'"),
        (("--candidate", "a=frame.exr", "--candidate", "a=frame.exr"), "two candidates are called 'a'"),
        (("--candidate", "frame=frame.exr"), "cannot be called 'frame'"),
        (("--candidate-command", "x=engine {gtlf}"), "did you mean 'gltf'"),
        (("--candidate-command", "x=engine 'oops"), "cannot be split"),
        (("--candidate-command", "x= "), "expected a command"),
        (("--candidate", "a=frame.exr", "--register", "exposur"), "did you mean 'exposure'"),
        (("--candidate", "a=frame.exr", "--register", "background"), "--no-background"),
        (("--candidate", "srgb=frame.exr"), "cannot be called 'srgb'"),
        (("--candidate", "a=frame.exr", "--transfer", "sRGB"), "srgb"),
        (("--register", "exposure"), "no candidate"),
        (("--candidate", "a=frame.exr", "--timeout", "-1"), "--timeout"),
        (("--renderer", "nobody"), "no renderer 'nobody'"),
    ],
)
def test_words_that_make_no_sense(texts, said):
    with pytest.raises(UsageError, match=said):
        words.candidates(parsed(*texts))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('name = "a"', "one of file, command and renderer"),
        ('name = "a"\nfile = "x"\ncommand = "y"', "one of file, command and renderer"),
        ('name = "a"\nfile = "x"\nregister = ["shft"]', "shift"),
        ('name = "a"\nfile = "x"\ntimout = 3', "timeout"),
    ],
)
def test_descriptions_that_make_no_sense(run, tmp_path, text, said):
    (tmp_path / "lightmeter.toml").write_text(f"[[candidate]]\n{text}\n")
    ran = run("compare", "plane", "--candidate", "a")
    assert ran.code == 2
    assert said in ran.err


def test_a_registered_renderer_is_called_in_a_process_of_its_own(tmp_path, monkeypatch):
    """As an installed package would register it: by the metadata of a distribution on the path."""
    package = tmp_path / "site"
    (package / "grey-1.dist-info").mkdir(parents=True)
    (package / "grey-1.dist-info" / "METADATA").write_text("Metadata-Version: 2.1\nName: grey\nVersion: 1\n")
    (package / "grey-1.dist-info" / "entry_points.txt").write_text("[lightmeter.renderers]\ngrey = grey:render\n")
    (package / "grey.py").write_text(
        "import numpy\nfrom lightmeter.reports.image_files import write_exr\n"
        "def render(job):\n"
        "    write_exr(job.image, numpy.full((job.size[1], job.size[0], 3), 0.5))\n"
        '    job.side_file.write_text(\'{"engine": "grey"}\')\n'
    )
    monkeypatch.setenv("PYTHONPATH", str(package))
    monkeypatch.syspath_prepend(str(package))
    (one,) = words.candidates(parsed("--renderer", "grey"))
    job = Job(tmp_path, tmp_path, None, (3, 2), tmp_path / "out.exr", tmp_path / "out.json")
    files = obtain(one, job)
    assert files.image.is_file()
    assert files.side_file.read_text() == '{"engine": "grey"}'
    assert files.seconds > 0
