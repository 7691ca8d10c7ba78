"""An engine's layers in the place of our effects' buffers, at the pixels' centres."""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from lightmeter.candidates.handed import Handed
from lightmeter.candidates.layer_names import LAYERS
from lightmeter.exact_batch import ExactBatch
from lightmeter.realtime.renderer import Capture, Renderer
from lightmeter.scenes.points import SurfacePoints
from lightmeter.scenes.terms import TERMS
from lightmeter.truth import Truth
from lightmeter.variants import Variants


@dataclass(frozen=True, eq=False)
class Centres:
    """The surface points that pixels' centres show, with the oracles there.

    Attributes:
        points: (1, H, W).
    """

    truth: Truth
    points: SurfacePoints
    forward: np.ndarray
    eye: np.ndarray

    @classmethod
    def of(cls, renderer: Renderer, truth: Truth) -> "Centres":
        """Of a scene and size, on the true surface: an engine is not held to the triangles of our effects."""
        camera, exact = truth.scene.camera, renderer.plan.effects_of("surface")
        points = Variants(renderer, truth).see(exact, np.zeros((1, 2)), terms=False).points
        return cls(truth, points, -camera.matrix[:3, 2], camera.position)

    @cached_property
    def exact_points(self) -> SurfacePoints:
        """The points with the truth's own unfiltered textures."""
        return self.truth.exact_material(self.points)

    @cached_property
    def exact(self) -> list[ExactBatch]:
        """Every batch of every term."""
        spp = self.truth.reference.spp
        return [self.batch(number, spp) for number in range(self.truth.batches)]

    def batch(self, number: int, spp: int, terms: Collection[str] = tuple(TERMS)) -> ExactBatch:
        """One batch of some terms."""
        points = self.exact_points
        family = "frame" if points is self.points else "exact material"
        return self.truth.batch(points, number, family, spp, terms=terms)

    @property
    def depth(self) -> np.ndarray:
        """(H, W) metres along the camera's forward axis."""
        return (self.points.position[0].astype(np.float64) - self.eye) @ self.forward


def contributions(handed: Handed, name: str, exact: ExactBatch) -> tuple[np.ndarray, np.ndarray]:
    """A layer's part of the image and its oracle's, in radiance, (H, W, 3) each.

    A visibility is weighted with the exact unshadowed radiance: where nothing arrives a wrong shadow costs nothing.
    """
    layer, values = handed.layers[name]
    return _BY_KIND[layer.kind](values, layer.light, exact)


def _at_centre(image: np.ndarray | None) -> np.ndarray:
    assert image is not None, "`check_fit` has seen to it"
    return image[0]


_BY_KIND: Mapping[str, Callable[[np.ndarray, int | None, ExactBatch], tuple[np.ndarray, np.ndarray]]] = {
    "direct": lambda v, _n, e: (v, np.sum([_at_centre(b) for b in e.direct.values()], axis=0)),
    "direct.N": lambda v, n, e: (v, _at_centre(e.direct[n])),
    "visibility.N": lambda v, n, e: (v * _at_centre(e.direct[n]), _at_centre(e.shadowed[n])),
    "environment": lambda v, _n, e: (v, _at_centre(e.environment)),
    "ambient_visibility": lambda v, _n, e: (v * _at_centre(e.environment), _at_centre(e.environment_shadowed)),
    "indirect": lambda v, _n, e: (v, _at_centre(e.indirect)),
    "transmission": lambda v, _n, e: (v, _at_centre(e.transmission)),
}


def is_term(name: str, handed: Handed) -> bool:
    """Whether a layer is a term of the light transport, with an oracle."""
    return handed.layers[name][0].kind in _BY_KIND


def as_capture(handed: Handed, points: SurfacePoints) -> Capture:
    """The layers as an effect's buffers would be: what has no layer is absent, and counts as not approximated."""
    direct, visibility, frame = {}, {}, {}
    for layer, values in handed.layers.values():
        term = LAYERS[layer.kind].term
        if layer.kind == "direct.N":
            direct[layer.light] = values
        elif layer.kind == "visibility.N":
            visibility[layer.light] = values
        elif term and layer.kind != "direct":
            frame[term] = values
    return Capture(points, direct, visibility, frame)
