"""Closure: the composition with every term exact, to be held against the reference."""

import numpy as np

from lightmeter.families import offset_layers
from lightmeter.realtime.renderer import Renderer
from lightmeter.truth import Truth
from lightmeter.variants import Variants


def closure_batches(renderer: Renderer, truth: Truth, **spending) -> np.ndarray:
    """(K, H, W, 3) float32: images with every term exact, each at sub-pixel offsets of its own.

    Args:
        spending: samples, emission_spp, spp and report, as `offset_layers` takes them.
    """
    variants = Variants(renderer, truth)
    return np.stack([images[0] for images in offset_layers(variants, variants.everyone, **spending)])
