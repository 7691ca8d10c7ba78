"""Pages that are made from the program say what the program says."""

from pathlib import Path

from lightmeter.commands.effects import markdown
from lightmeter.realtime.discovery import effects

ROOT = Path(__file__).parent.parent


def test_the_effects_reference_is_fresh():
    """Refresh it with `lightmeter effects --markdown > docs/effects.md`."""
    assert (ROOT / "docs/effects.md").read_text(encoding="utf-8") == markdown(effects().values())


def test_every_effect_is_explained():
    page = markdown(effects().values())
    assert all(f"## {name}\n" in page for name in effects())
