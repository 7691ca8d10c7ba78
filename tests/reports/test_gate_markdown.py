"""The comment on a pull request: its size, its order, and that names are shown as they stand."""

from lightmeter.metrics.measurement import Measurement
from lightmeter.reports.gate_markdown import LONGEST, to_markdown
from lightmeter.reports.verdict import Verdict


def verdict(status: str, scene: str = "posts", message: str = "as measured") -> Verdict:
    measured = Measurement(0.5, 0.4, 0.6)
    return Verdict(f"{scene}/frame/rmse", status, measured, "rmse <= 1", message, 1.25, scene, "frame", samples=18)


def test_a_comment_says_the_worst_first():
    text = to_markdown([verdict("FAIL"), verdict("PASS")], {("posts", "frame"): "c.1.png"}, 0.999, 2.0)
    lines = text.splitlines()
    assert lines[0] == "### ❌ lightmeter: 1 failed, 1 held"
    assert "| ❌ FAIL | posts/frame | rmse \\<= 1 | 0.50 ± 0.10 | 18 | 1.2 |" in lines
    assert text.index("</summary>") < text.index("![FLIP](c.1.png)") < text.index("</details>")
    assert to_markdown([verdict("PASS")], {}, 0.999, 1.0).startswith("### ✅ lightmeter: 1 held")
    assert to_markdown([verdict("UNDECIDED")], {}, 0.999, 1.0).startswith("### ❔ lightmeter: 1 undecided")


def test_a_comment_is_never_too_long_and_says_what_it_left_out():
    many = [verdict("FAIL", f"scene {n}", "m" * 5000) for n in range(3000)]
    text = to_markdown(many, {(f"scene {n}", "frame"): f"c.{n}.png" for n in range(12)}, 0.999, 1.0)
    assert 0.5 * LONGEST < len(text) <= LONGEST
    assert "more are not shown" in text and text.count("<details>") == text.count("</details>") == 1


def test_names_are_no_markup():
    text = to_markdown([verdict("FAIL", "a|b<img>@me\n# x")], {}, 0.999, 1.0)
    row = next(line for line in text.splitlines() if "FAIL" in line and line.startswith("|"))
    assert "a\\|b\\<img\\>\\@me \\# x/frame" in row
