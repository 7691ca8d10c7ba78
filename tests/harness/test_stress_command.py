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


def test_laws_of_a_brdf(run, tmp_path):
    found = run("stress", "--function", "phong/phong#2", "-o", "out")
    assert "Laws of reflection" in found.out and "not reciprocal, by its definition" in found.out
    held = json.loads((tmp_path / "out/stress.json").read_text())["laws"]["phong/phong#2"]
    for line in (line for line in found.out.splitlines() if "--law" in line):
        words = shlex.split(line.partition(": lightmeter ")[2])
        law = words[words.index("--law") + 1]
        again = run(*words, "--json").json
        kept = held["albedo"] if law == "albedo" else held["reciprocity"]["model"]
        assert {**again, "inputs": None} == {**kept, "inputs": None}
    page = (tmp_path / "out/stress.html").read_text()
    assert page.count("--law") == 2
    assert "Laws of reflection" not in run("stress", "--function", "d_ggx", "-o", "other").out


def test_a_law_at_one_input(run, refused):
    white = ["base_color=1,1,1", "metallic=1", "roughness=1", "specular=1"]
    found = run("stress", "--function", "gltf_brdf", "--law", "albedo", "--input", *white, "n_dot_v=1")
    assert found.code == 0 and "0.30685" in found.out  # 1 − ln 2
    of = ("stress", "--law", "albedo", "--function")
    assert "0.001 to 1" in refused(*of, "gltf_brdf", "--input", *white, "n_dot_v=0")
    assert "no n_dot_v" in refused(*of, "gltf_brdf", "--input", *white)
    assert "is no BRDF" in refused(*of, "d_ggx", "--input", "alpha=1")
    assert "has no albedo" in refused(*of, "v_schlick", "--input", "k=1")
    assert "with --function and --input" in refused(*of, "gltf_brdf")
    along = ("n=0,0,1", "v=1,0,0", "l=0,0,1")
    said = refused("stress", "--law", "reciprocity", "--function", "gltf_brdf", "--input", *white, *along)
    assert "at least 0.001 to the normal" in said


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


def test_the_gate_holds_laws(run, tmp_path):
    (tmp_path / "lightmeter.toml").write_text(
        '[[stress]]\nfunction = "lambert"\nmetric = "albedo"\nmax = 1\n'
        '[[stress]]\nfunction = "lambert"\nmetric = "reciprocity"\nmax = 0.01\n'
        '[[stress]]\nfunction = "phong/phong#2"\nmetric = "albedo"\nmax = 1.5\n'
    )
    found = run("gate", "--json")
    assert found.code == 1
    assert [v["status"] for v in found.json["verdicts"]] == ["PASS", "PASS", "FAIL"]
    words = shlex.split(re.search(r"`lightmeter (.*)`", found.json["verdicts"][2]["message"])[1])
    assert run(*words, "--json").json["device"] > 1.5


def test_stress_limits_that_make_no_sense(refused, tmp_path):
    def said(text: str) -> str:
        (tmp_path / "lightmeter.toml").write_text(f"[[stress]]\n{text}\n")
        return refused("gate")

    assert 'metric = "digits" with min' in said('metric = "digits"\nmax = 1')
    assert "whole number" in said('metric = "faults"\nmax = 0.5')
    assert "leave out alpha" in said('metric = "albedo"\nmax = 1\nalpha = 0.1')
    assert "another metric with max" in said('metric = "albedo"\nmin = 1')
    assert "reaches no function that is a BRDF" in said('metric = "albedo"\nmax = 1\nfunction = "d_ggx"')
    assert "not on several" in said('metric = "faults"\nmax = 0\neffect = "lambert"\nfunction = "lambert"')
    assert "did you mean 'grazing'" in said('metric = "faults"\nmax = 0\nregime = "grasing"\nfunction = "lambert"')
    assert "reaches no input" in said('metric = "digits"\nmin = 1\nalpha = 0.1\nfunction = "lambert"')
    assert "toml: stress: there is no effect 'lamberd'; did you mean" in said(
        'metric = "faults"\nmax = 0\neffect = "lamberd"'
    )


def test_stiff_scenes(run, tmp_path):
    document = run("stress", "--scenes", "nan-texel", "no-lights", "--use", "gtao", "--json", "-o", "out").json
    found = {f["name"]: f for f in document["scenes"]}
    assert found["nan-texel"]["refused"]
    assert "1 NaN" in found["nan-texel"]["words"]
    assert found["no-lights"]["finite"]
    assert document == json.loads((tmp_path / "out/stiff.json").read_text())
    assert found["nan-texel"]["commands"] == ["lightmeter stress --scenes nan-texel --use gtao"]
    again = "lightmeter compare stiff/no-lights --size 24x24 --use gtao"
    assert found["no-lights"]["commands"][1] == again and again in (tmp_path / "out/stiff.html").read_text()
    table = run("stress", "--scenes", "inf-texel")
    assert table.code == 0
    assert "refused" in table.out and "stiff.html" in table.out
    assert "did you mean 'nan-texel'" in run("stress", "--scenes", "nan-texl").err.lower()
    assert "takes the place of effects" in run("stress", "gtao", "--scenes").err
    assert "give it with --scenes" in run("stress", "gtao", "--use", "gtao").err


def test_a_stiff_scene_is_a_scene_of_every_command(run, refused, tmp_path):
    assert run("export", "stiff/duplicates", "-o", "out").code == 0
    assert (tmp_path / "out/scene.gltf").exists()
    assert "did you mean 'stiff/small'" in refused("compare", "stiff/smal").lower()
    assert "1 NaN" in refused("compare", "stiff/nan-texel")


def test_the_gate_holds_limits_on_stiff_scenes(run, tmp_path):
    faults = '[[stress]]\nscene = "n*-texel"\nmetric = "faults"\nmax = 0\n'
    changed = '[[stress]]\nscene = "coplanar-*"\nmetric = "changed"\nmax = 0.1\n'
    error = '[[stress]]\nscene = "no-objects"\nmetric = "nrmse"\nmax = 0.1\n'
    (tmp_path / "lightmeter.toml").write_text(faults + changed + error)
    found = run("gate", "--json", "--junit", "junit.xml")
    assert found.code == 1, found.err
    statuses = {v["name"]: v["status"] for v in found.json["verdicts"]}
    assert statuses == {
        "stiff/no-objects/frame/nrmse": "PASS",
        "stress/nan-texel/faults": "PASS",
        "stress/negative-texel/faults": "PASS",
        "stress/coplanar-reversed/changed": "FAIL",
    }
    assert "cook_torrance" in found.err and "lightmeter stress --scenes coplanar-reversed" in found.err
    assert 'failures="1"' in (tmp_path / "junit.xml").read_text()


def test_limits_on_scenes_that_make_no_sense(refused, tmp_path):
    def said(text: str) -> str:
        (tmp_path / "lightmeter.toml").write_text(f"[[stress]]\n{text}\n")
        return refused("gate")

    assert "on several" in said('scene = "small"\nfunction = "lambert"\nmetric = "faults"\nmax = 0')
    assert "expected scene" in said('function = "lambert"\nmetric = "changed"\nmax = 0')
    assert '"changed" or "nrmse" with max' in said('scene = "small"\nmetric = "digits"\nmin = 3')
    assert "are of functions" in said('scene = "small"\nmetric = "changed"\nmax = 0.1\nalpha = 0.1')
    assert "a whole number" in said('scene = "small"\nmetric = "faults"\nmax = 0.5')
    assert "need not look like another" in said('scene = "white"\nmetric = "changed"\nmax = 0.1')
    assert "did you mean 'slivers'" in said('scene = "sliver"\nmetric = "nrmse"\nmax = 0.1')
    assert "no scene file" in said('scene = "sliver"\nmetric = "faults"\nmax = 0')
