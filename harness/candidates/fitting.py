"""Whether what was handed in is of this scene: told before the truth is asked for."""

from lightmeter.candidates.failure import CandidateError
from lightmeter.candidates.handed import Handed
from lightmeter.candidates.layer_names import LAYERS
from lightmeter.hints import nearest
from lightmeter.scenes.features import missing_terms
from lightmeter.scenes.model import Scene


def check_fit(handed: Handed, scene: Scene) -> None:
    """Every layer is of something that the scene has, and so is everything that is named as unsupported.

    Raises:
        CandidateError: it is not; names the nearest.
    """
    _check_names("material", handed.unsupported.materials, {shape.material.name for shape in scene.shapes}, scene)
    _check_names("object", handed.unsupported.objects, {shape.name for shape in scene.shapes}, scene)
    _check_layers(handed, scene)


def _check_layers(handed: Handed, scene: Scene) -> None:
    missing, lights = missing_terms(scene), len(scene.all_lights)
    for name, (layer, _) in handed.layers.items():
        if layer.light is not None and layer.light >= lights:
            raise CandidateError(
                f"its layer {name} is of light {layer.light}, and {scene.name} has {lights} "
                f"({'numbered from 0' if lights else 'none'}); camera.json lists them"
            )
        term = LAYERS[layer.kind].term
        if term in missing:
            raise CandidateError(f"its layer {name} gives {term}, which {scene.name} does not have: {missing[term]}")


def _check_names(kind: str, names: tuple[str, ...], known: set[str], scene: Scene) -> None:
    for name in names:
        if name not in known:
            raise CandidateError(
                f"it names the unsupported {kind} {name!r}, which {scene.name} does not have; "
                + nearest(name, sorted(known))
            )
