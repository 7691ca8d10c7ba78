"""Finds the twins: those of the shared shaders, and `TWINS` in the `twin.py` of every effect that has one."""

from importlib import import_module
from pathlib import Path

from .ambient.twin import TWINS as AMBIENT_TWINS
from .discovery import effects
from .environments.twin import TWINS as ENVIRONMENT_TWINS
from .glass.twin import TWINS as GLASS_TWINS
from .packing_twins import TWINS as PACKING_TWINS
from .pictures.twin import TWINS as PICTURE_TWINS
from .reflections.twin import TWINS as REFLECTION_TWINS
from .shaders import SHARED
from .shadows.twin import TWINS as SHADOW_TWINS
from .shared_twins import TWINS as SHARED_TWINS
from .twin import Twin


def declared_twins() -> list[tuple[Path, Twin]]:
    """(folder, twin) of every declaration."""
    found = [
        (SHARED, twin)
        for twin in (
            *SHARED_TWINS,
            *SHADOW_TWINS,
            *AMBIENT_TWINS,
            *ENVIRONMENT_TWINS,
            *PACKING_TWINS,
            *GLASS_TWINS,
            *PICTURE_TWINS,
            *REFLECTION_TWINS,
        )
    ]
    for effect in effects().values():
        if (effect.folder / "twin.py").is_file():
            module = import_module(f"lightmeter.realtime.effects.{effect.name}.twin")
            found += [(effect.folder, twin) for twin in module.TWINS]
    return found
