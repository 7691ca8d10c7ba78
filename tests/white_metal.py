"""Published numbers of a white metal: single scattering GGX, F = 1, height-correlated Smith."""

import numpy as np

ALBEDOS = (
    (1.0, 1.0, 1 - np.log(2)),
    (0.25, 1.0, 0.9158),
    (0.09, 1.0, 0.9907),
    (1.0, 0.5, 0.4507),
    (0.25, 0.5, 0.8573),
    (0.09, 0.5, 0.9751),
)
"""α, the cosine to the normal, and the directional albedo: in closed form, or four digits."""

LOSSES = ((1.0, 0.591), (0.5, 0.300), (0.25, 0.118))
"""α, and what is lost under light from everywhere: 1 − 2∫E(µ)µ dµ."""
