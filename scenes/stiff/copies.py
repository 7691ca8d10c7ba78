"""A scene of the user's own, and copies of it that must look the same: where they do not, its numbers are to blame."""

import numpy as np

from lightmeter.scenes.load import load
from lightmeter.scenes.model import Scene
from lightmeter.scenes.moving import moved, scaled
from lightmeter.scenes.stiff.case import StiffCase
from lightmeter.scenes.stiff.coordinates import THOUSAND

SIZE = (64, 64)


def copies(source: str) -> dict[str, StiffCase]:
    """The scene as it is, a thousand times smaller, as much larger, and a thousand times its size from the origin.

    Args:
        source: whatever `load` takes; the cases are named after it.

    Raises:
        SceneError: there is no such scene, or its file is wrong.
    """
    scene = load(source)
    away = np.array([_away(scene), 0.0, 0.0])
    return {
        source: StiffCase("as it is", lambda: scene, SIZE),
        f"{source} small": StiffCase(
            "a thousand times smaller", lambda: scaled(scene, 1 / THOUSAND), SIZE, source, scale=1 / THOUSAND
        ),
        f"{source} large": StiffCase(
            "a thousand times larger", lambda: scaled(scene, THOUSAND), SIZE, source, scale=THOUSAND
        ),
        f"{source} far": StiffCase(f"{away[0]:.3g} m from where it is", lambda: moved(scene, away), SIZE, source),
    }


def _away(scene: Scene) -> float:
    """A thousand times what its coordinates reach, as a power of two: float32 then holds the scene to 14 bits."""
    reach = float(np.abs(np.stack([*scene.bounds, scene.camera.position])).max())
    return THOUSAND * 2.0 ** np.ceil(np.log2(max(reach, 1e-30)))
