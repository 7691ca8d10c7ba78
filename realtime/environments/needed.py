"""When a scene needs a technique for environment maps."""

from lightmeter.scenes.model import Scene


def same_everywhere(scene: Scene) -> str:
    """Why a scene without a map needs none; "" where it has one."""
    has_map = scene.environment is not None and scene.environment.map is not None
    return "" if has_map else "the environment is the same from everywhere"
