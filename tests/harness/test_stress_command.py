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
    assert "nothing to stress" in refused("stress", "supersampling")
    assert "did you mean 'd_ggx'" in refused("stress", "--function", "d_gx")
    assert "name the function" in refused("stress", "--input", *INPUT)
    assert "there is no alpha" in refused("stress", "--function", "d_ggx", "--input", *INPUT[:2])
    assert "did you mean 'alpha'" in refused("stress", "--function", "d_ggx", "--input", "alfa=1")
    assert "float32 can hold" in refused("stress", "--function", "d_ggx", "--input", "alpha=1e39")
    assert "float32 can hold" in refused("stress", "--function", "d_ggx", "--input", "alpha=1,2")
    assert "given twice" in refused("stress", "--function", "d_ggx", "--input", "alpha=1", "alpha=1")
    assert "several functions" in refused("stress", "--function", "reflected", "--input", "alpha=1")
    assert "--seed" in refused("stress", "--seed", "-1")


def test_the_gate_holds_limits_on_it(run, tmp_path):
    held = '[[stress]]\nfunction = "shared/d_ggx"\nmetric = "digits"\nmin = 3\nalpha = 0.002\n'
    none = '[[stress]]\nfunction = "shared/d_ggx"\nmetric = "faults"\nmax = 0\n'
    (tmp_path / "lightmeter.toml").write_text(held + none)
    found = run("gate", "--json")
    assert found.code == 0, found.err
    assert [v["status"] for v in found.json["verdicts"]] == ["PASS", "PASS"]
    # D's peak leaves a half float's range below α = 2.2e-3.
    (tmp_path / "lightmeter.toml").write_text(held + 'format = "fp16"\n')
    failed = run("gate")
    assert failed.code == 1 and "0 PASS, 1 FAIL" in failed.out
    assert "lightmeter stress --function 'shared/d_ggx' --input" in failed.err
    (verdict,) = run("gate", "--json").json["verdicts"]
    words = shlex.split(re.search(r"`lightmeter (.*)`", verdict["message"])[1])
    assert float(next(w for w in words if w.startswith("alpha=")).removeprefix("alpha=")) < 2.3e-3
    assert run(*words, "--json").json["fp16"]["digits"] < 3


def test_stress_limits_that_make_no_sense(refused, tmp_path):
    def said(text: str) -> str:
        (tmp_path / "lightmeter.toml").write_text(f"[[stress]]\n{text}\n")
        return refused("gate")

    assert 'metric = "digits" with min' in said('metric = "digits"\nmax = 1')
    assert "not on both" in said('metric = "faults"\nmax = 0\neffect = "lambert"\nfunction = "lambert"')
    assert "did you mean 'grazing'" in said('metric = "faults"\nmax = 0\nregime = "grasing"\nfunction = "lambert"')
    assert "reaches no input" in said('metric = "digits"\nmin = 1\nalpha = 0.1\nfunction = "lambert"')
    assert "toml: stress: there is no effect 'lamberd'; did you mean" in said(
        'metric = "faults"\nmax = 0\neffect = "lamberd"'
    )


def test_stiff_scenes(run):
    found = {f["name"]: f for f in run("stress", "--scenes", "nan-texel", "no-lights", "--json").json}
    assert found["nan-texel"]["refused"]
    assert "1 NaN" in found["nan-texel"]["words"]
    assert found["no-lights"]["finite"]
    table = run("stress", "--scenes", "inf-texel")
    assert table.code == 0
    assert "refused" in table.out
    assert "did you mean 'nan-texel'" in run("stress", "--scenes", "nan-texl").err.lower()
    assert "takes the place of effects" in run("stress", "gtao", "--scenes").err
