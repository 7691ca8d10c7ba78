"""An irradiance cube map: the environment under the cosine, for every normal, baked."""

from ...effect import Effect, Knob, Knobs
from ...environments.needed import same_everywhere


def defines(knobs: Knobs) -> dict[str, object]:
    """The cube's side."""
    return {"IRRADIANCE_SIDE": int(knobs["size"])}


EFFECT = Effect(
    name="irradiance_cube",
    terms=("environment",),
    summary="Irradiance looked up along the normal in a baked cube map; the specular lobe gets that of the mirror "
    "direction, as if it were as wide as the base's.",
    citation="Greene 1986, Environment Mapping and Other Applications of World Projections (diffuse); Křivánek & "
    "Colbert 2008, Real-time Shading with Filtered Importance Sampling; Karis 2014 (environment BRDF)",
    knobs=(
        Knob(
            "size",
            32,
            "Side of a face.",
            unit="texels",
            choices=(4, 8, 16, 32, 64, 128),
            sweep=(4, 8, 16, 32, 64),
        ),
        Knob(
            "samples",
            256,
            "Directions for each texel, drawn from the cosine.",
            low=1,
            high=4096,
            sweep=(16, 64, 256, 1024),
        ),
        Knob(
            "filtered",
            True,
            "Each direction stands for the solid angle it represents; else it is a point, and a sun is met or missed.",
            sweep=(False, True),
        ),
    ),
    rank=2,
    channels=("position", "normal", "roughness", "base_color", "metallic", "specular"),
    unneeded=same_everywhere,
    defines=defines,
)
