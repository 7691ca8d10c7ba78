"""`lightmeter diff A B`: the rules for what files mean, and files that are damaged."""

import numpy as np
import pytest

from lightmeter.scenes.optics.color import srgb_decode, srgb_encode

from .small_images import exr, hdr, noise, png

DISPLAY = {"ssim", "flip", "delta_e_2000", "psnr"}


@pytest.fixture
def metrics(run):
    """Runs `diff` with --json; gives the values by name."""

    def call(*words):
        found = run("diff", *words, "--json", "-o", "out")
        assert found.code == 0, found.err
        return {name: entry["value"] for name, entry in found.json["frame"]["metrics"].items()}

    return call


def test_everything_is_written(run, tmp_path):
    exr(tmp_path / "a.exr", noise(seed=1))
    exr(tmp_path / "b.exr", noise(seed=2))
    found = run("diff", "a.exr", "b.exr", "-o", "out")
    assert found.code == 0
    assert "HDR-FLIP" in found.out
    assert "report: out/report.html" in found.out
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        "report.html",
        "results.json",
        "layers.exr",
        "heatmaps",
    }
    assert {path.name for path in (tmp_path / "out" / "heatmaps").iterdir()} == {
        "frame.flip.png",
        "frame.rms.png",
        "frame.signed.png",
    }


def test_json_is_the_results_file(run, tmp_path):
    png(tmp_path / "a.png", noise(seed=1))
    png(tmp_path / "b.png", noise(seed=2))
    found = run("diff", "a.png", "b.png", "--json", "-o", "out")
    assert found.out == (tmp_path / "out" / "results.json").read_text(encoding="utf-8")
    assert found.json["scene"] == "a.png against b.png"
    assert found.json["reference"] is None
    assert found.json["closure"] is None


def test_a_file_against_itself_is_no_error(metrics, tmp_path):
    exr(tmp_path / "a.exr", 4 * noise())
    found = metrics("a.exr", "a.exr")
    assert found.pop("psnr") == "Infinity"
    assert found.pop("ssim") == pytest.approx(1)
    assert all(abs(value) < 1e-6 for value in found.values()), found


def test_display_images_are_measured_on_code_values_and_on_their_light(metrics, tmp_path):
    a, b = (np.round(noise(seed=seed) * 255) / 255 for seed in (1, 2))
    png(tmp_path / "a.png", a)
    png(tmp_path / "b.png", b)
    found = metrics("a.png", "b.png")
    assert found["psnr"] == pytest.approx(-10 * np.log10(np.mean((a - b) ** 2)), rel=1e-5)
    light = srgb_decode(a.astype(np.float64)) - srgb_decode(b.astype(np.float64))
    assert found["rmse"] == pytest.approx(np.sqrt(np.mean(light**2)), rel=1e-5)
    assert "flip_hdr" not in found


def test_scene_linear_images_are_measured_on_radiance_and_shown_exposed(metrics, tmp_path):
    a, b = 4 * noise(seed=1), 4 * noise(seed=2)
    exr(tmp_path / "a.exr", a)
    exr(tmp_path / "b.exr", b)
    dark, plain = metrics("a.exr", "b.exr", "--exposure", "-2"), metrics("a.exr", "b.exr")
    assert dark["rmse"] == plain["rmse"] == pytest.approx(np.sqrt(np.mean((a - b) ** 2)), rel=1e-5)
    assert dark["flip_hdr"] == plain["flip_hdr"]
    png(tmp_path / "a.png", srgb_encode(a / 4))
    png(tmp_path / "b.png", srgb_encode(b / 4))
    shown = metrics("a.png", "b.png")
    for name in ("flip", "ssim", "delta_e_2000"):
        assert dark[name] == pytest.approx(shown[name], rel=0.02)
        assert dark[name] != pytest.approx(plain[name], rel=0.02)


def test_beside_a_display_image_a_scene_linear_one_is_shown_first(metrics, tmp_path):
    a = 4 * noise()
    exr(tmp_path / "a.exr", a)
    png(tmp_path / "b.png", srgb_encode(a / 4))
    found = metrics("a.exr", "b.png", "--exposure", "-2")
    assert found["flip"] < 0.02
    assert found["psnr"] > 50
    assert metrics("a.exr", "b.png")["flip"] > 0.1


def test_transfer_says_what_the_files_do_not(metrics, tmp_path):
    values = np.round(noise() * 255) / 255
    png(tmp_path / "linear.png", values)
    exr(tmp_path / "linear.exr", values)
    exr(tmp_path / "other.exr", noise(seed=2))
    taken, real = metrics("linear.png", "other.exr", "--transfer", "linear"), metrics("linear.exr", "other.exr")
    assert taken == pytest.approx(real, rel=1e-5)
    assert set(metrics("linear.exr", "other.exr", "--transfer", "srgb")) == set(real) - {"flip_hdr", "delta_e_itp"}


def test_hdr_files_are_scene_linear(metrics, tmp_path):
    values = 4 * noise()
    hdr(tmp_path / "a.hdr", values)
    exr(tmp_path / "b.exr", values)
    found = metrics("a.hdr", "b.exr")
    assert found["nrmse"] < 0.01
    assert "flip_hdr" in found


def test_only_the_metrics_asked_for_in_their_order(run, tmp_path):
    exr(tmp_path / "a.exr", noise())
    found = run("diff", "a.exr", "a.exr", "--metric", "ssim,rmse", "--json")
    assert list(found.json["frame"]["metrics"]) == ["ssim", "rmse"]


def test_pixels_per_degree_reach_flip(metrics, tmp_path):
    exr(tmp_path / "a.exr", noise(seed=1))
    exr(tmp_path / "b.exr", noise(seed=2))
    near, far = (metrics("a.exr", "b.exr", "--ppd", ppd) for ppd in (20, 120))
    assert near["flip"] > far["flip"]
    assert near["rmse"] == far["rmse"]


def test_what_is_not_finite_is_counted_placed_and_never_averaged(run, tmp_path):
    bad = noise()
    bad[3, 4, 1] = np.nan
    bad[5, 6] = np.inf
    exr(tmp_path / "bad.exr", bad)
    exr(tmp_path / "b.exr", noise(seed=2))
    found = run("diff", "bad.exr", "b.exr", "--json", "-o", "out")
    assert found.json["nonfinite"]["frame"] == 2
    assert found.json["nonfinite"]["where"]["frame"] == [[4, 3], [6, 5]]
    assert {metric["value"] for metric in found.json["frame"]["metrics"].values()} == {"NaN"}
    assert "2 pixels are not finite" in run("diff", "bad.exr", "b.exr", "-o", "out").out


def test_a_display_transform_does_not_hide_an_infinity(run, tmp_path):
    bad = noise()
    bad[5, 6] = np.inf
    exr(tmp_path / "bad.exr", bad)
    png(tmp_path / "b.png", noise())
    document = run("diff", "bad.exr", "b.png", "--json").json
    assert document["nonfinite"]["frame"] == 1
    assert {metric["value"] for metric in document["frame"]["metrics"].values()} == {"NaN"}


def test_a_reference_that_is_not_finite_is_refused(refused, tmp_path):
    bad = noise()
    bad[3, 4, 1] = np.nan
    exr(tmp_path / "bad.exr", bad)
    exr(tmp_path / "a.exr", noise())
    message = refused("diff", "a.exr", "bad.exr")
    assert "bad.exr" in message
    assert "row 3, column 4" in message


def test_negative_values_follow_a_stated_rule(run, tmp_path):
    values = noise()
    values[0, 0] = -1
    exr(tmp_path / "negative.exr", values)
    exr(tmp_path / "b.exr", noise(seed=2))
    found = run("diff", "negative.exr", "b.exr", "--json")
    assert any("1 pixel with negative values" in note for note in found.json["notes"])


def test_images_of_other_sizes_are_refused(refused, tmp_path):
    png(tmp_path / "a.png", noise(24, 16))
    png(tmp_path / "b.png", noise(16, 24))
    message = refused("diff", "a.png", "b.png")
    assert "24×16" in message
    assert "16×24" in message


def test_small_images_leave_out_what_cannot_be(run, refused, tmp_path):
    png(tmp_path / "a.png", noise(3, 2))
    found = run("diff", "a.png", "a.png", "--json")
    assert {item["what"] for item in found.json["left_out"]} >= {"ssim"}
    assert "SSIM's window" in refused("diff", "a.png", "a.png", "--metric", "ssim")


def test_a_layer_is_chosen_by_name(run, refused, tmp_path):
    png(tmp_path / "a.png", noise(seed=1))
    png(tmp_path / "b.png", noise(seed=2))
    run("diff", "a.png", "b.png", "-o", "out")
    words = ("out/layers.exr", "out/layers.exr", "--layer", "frame.truth", "--reference-layer", "frame.truth")
    assert run("diff", *words, "--json").json["frame"]["metrics"]["rmse"]["value"] == 0
    assert "frame.trth" in refused("diff", "out/layers.exr", "a.png", "--layer", "frame.trth")
    assert "no layers" in refused("diff", "a.png", "b.png", "--layer", "frame.truth")


def test_exposing_display_images_is_refused(refused, tmp_path):
    png(tmp_path / "a.png", noise())
    assert "--exposure" in refused("diff", "a.png", "a.png", "--exposure", "1")
    assert "--ppd" in refused("diff", "a.png", "a.png", "--ppd", "0")


@pytest.mark.parametrize("write", [png, exr, hdr], ids=lambda write: write.__name__)
@pytest.mark.parametrize("damage", ["empty", "head", "cut", "noise", "claim"])
@pytest.mark.parametrize("place", [0, 1], ids=["tested", "reference"])
def test_damaged_images_are_refused_by_name(refused, tmp_path, write, damage, place):
    name = f"image.{write.__name__}"
    sound = write(tmp_path / f"sound.{write.__name__}", noise()).read_bytes()
    content = {
        "empty": b"",
        "head": sound[:20],
        "cut": sound[: len(sound) // 2],
        "noise": bytes(np.random.default_rng(3).integers(0, 256, 400, np.uint8)),
        "claim": {
            "png": sound[:16] + b"\x7f\xff\xff\xff\x7f\xff\xff\xff" + sound[24:],
            "exr": sound.replace(b"\x17\0\0\0\x0f\0\0\0", b"\xff\xff\xff\x0f\xff\xff\xff\x0f"),
            "hdr": sound.replace(b"-Y 16 +X 24", b"-Y 99999999 +X 99999999"),
        }[write.__name__],
    }[damage]
    assert content != sound
    (tmp_path / name).write_bytes(content)
    files = [name, f"sound.{write.__name__}"]
    assert name in refused("diff", *(files if place == 0 else files[::-1]))


def test_missing_files_and_folders_are_refused(refused, tmp_path):
    png(tmp_path / "a.png", noise())
    assert "nowhere.png" in refused("diff", "nowhere.png", "a.png")
    assert "nowhere.exr" in refused("diff", "a.png", "nowhere.exr")
    assert str(tmp_path) in refused("diff", "a.png", tmp_path)
