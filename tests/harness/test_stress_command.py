"""`lightmeter stress`: the table, the page, and the command that evaluates a cell's input again."""

import json
import re
import shlex

INPUT = ("n_dot_h=1", "sin2_h=0", "alpha=1e-06")


def test_table_json_and_page(run, tmp_path):
    found = run("stress", "--function", "d_ggx", "-o", "out")
    assert found.code == 0, found.err
    assert "d_ggx" in found.out and "shared/d_ggx keeps 1 % down to α = " in found.out
    assert max(map(len, found.out.splitlines()[:4])) <= 120
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"stress.html", "stress.json"}
    document = json.loads((tmp_path / "out/stress.json").read_text())
    (function,) = document["functions"]
    assert function["name"] == "shared/d_ggx"
    assert set(function["cells"]) == {"fp32", "fp16", "mediump"}  # a scalar is not written to three channels
    page = (tmp_path / "out/stress.html").read_text()
    assert "http" not in re.sub(r'(http-equiv|xmlns)="[^"]*"', "", page)


def test_a_cells_command_gives_its_numbers_again(run, tmp_path):
    run("stress", "--function", "shared/d_ggx", "-o", "out")
    page = (tmp_path / "out/stress.html").read_text()
    data = json.loads(re.search(r'id="data">(.*?)</script>', page, re.DOTALL)[1])
    cell = next(c for c in data["functions"][0]["cells"]["fp32"] if c and c["digits"] < 6.6)
    words = shlex.split(cell["command"])[1:]
    again = run(*words, "--json").json["fp32"]
    assert f"{again['got'][0]:.9g}" == cell["got"] and f"{again['exact'][0]:.9g}" == cell["exact"]
    assert f"{again['relative']:.3g}" == cell["relative"]


def test_one_input(run):
    found = run("stress", "--function", "d_ggx", "--input", *INPUT)
    assert found.code == 0 and "fp16" in found.out and "exact (float64)" in found.out


def test_what_is_wrong_is_said(refused):
    assert "did you mean 'cook_torrance'" in refused("stress", "cook_torance")
    assert "did you mean 'd_ggx'" in refused("stress", "--function", "d_gx")
    assert "name the function" in refused("stress", "--input", *INPUT)
    assert "there is no alpha" in refused("stress", "--function", "d_ggx", "--input", *INPUT[:2])
    assert "did you mean 'alpha'" in refused("stress", "--function", "d_ggx", "--input", "alfa=1")
    assert "float32 can hold" in refused("stress", "--function", "d_ggx", "--input", "alpha=1e39")
    assert "float32 can hold" in refused("stress", "--function", "d_ggx", "--input", "alpha=1,2")
    assert "given twice" in refused("stress", "--function", "d_ggx", "--input", "alpha=1", "alpha=1")
    assert "several functions" in refused("stress", "--function", "reflected", "--input", "alpha=1")
    assert "--seed" in refused("stress", "--seed", "-1")
