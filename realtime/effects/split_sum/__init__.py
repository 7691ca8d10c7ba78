"""The split sum: the environment filtered with the lobe, times the lobe's albedo; both baked."""

from lightmeter.scenes.layers import COAT, GRAIN, SHEEN

from ...effect import Effect, Knob, Knobs
from ...environments.needed import same_everywhere

COMPENSATIONS = {"none": "single_scattering", "fdez_aguera": "multiple_scattering"}
IRRADIANCE_SIDE = 32


def levels(knobs: Knobs) -> int:
    """How many levels there are: no more than end at faces of 2 texels."""
    return min(int(knobs["levels"]), int(knobs["size"]).bit_length() - 1)


def defines(knobs: Knobs) -> dict[str, object]:
    """Sizes, and the GLSL functions that stand for the parts."""
    cube = knobs["diffuse"] == "cube"
    return {
        "SPECULAR_SIDE": int(knobs["size"]),
        "LEVELS": levels(knobs),
        "IRRADIANCE_SIDE": IRRADIANCE_SIDE if cube else None,
        "COEFFICIENTS": 9,
        "BENT": knobs["grain"] == "bent",
        "COMPENSATION": COMPENSATIONS[str(knobs["compensation"])],
    }


EFFECT = Effect(
    name="split_sum",
    terms=("environment",),
    summary="The environment filtered with GGX's lobe along the mirror direction, times the lobe's albedo from a "
    "table; the base by irradiance.",
    citation="Karis 2013, Real Shading in Unreal Engine 4; Křivánek & Colbert 2008, Real-time Shading with Filtered "
    "Importance Sampling; Ramamoorthi & Hanrahan 2001; Fdez-Agüera 2019, A Multiple-Scattering Microfacet Model for "
    "Real-Time Image-based Lighting; Guy & Agopian 2018, Physically Based Rendering in Filament (coat, sheen); McAuley "
    "2015, Rendering the World of Far Cry 4 (bent normal)",
    knobs=(
        Knob(
            "size",
            128,
            "Side of a face of the filtered cube, at roughness 0.",
            unit="texels",
            choices=(16, 32, 64, 128, 256, 512),
            sweep=(16, 32, 64, 128, 256),
        ),
        Knob(
            "levels",
            6,
            "Levels of the cube, roughness 0 to 1 evenly over them; the last has faces of 2 texels or more.",
            low=2,
            high=9,
            sweep=(2, 3, 4, 6),
        ),
        Knob(
            "samples",
            64,
            "Directions for each texel of the cubes and of the table, drawn from the lobe.",
            low=1,
            high=4096,
            sweep=(4, 16, 64, 256),
        ),
        Knob(
            "filtered",
            True,
            "Each direction stands for the solid angle it represents; else it is a point, and a sun is met or missed.",
            sweep=(False, True),
        ),
        Knob("lut", 32, "Side of the table of albedos.", unit="texels", low=2, high=512, sweep=(4, 8, 16, 32, 64)),
        Knob(
            "diffuse",
            "sh",
            f"The base's irradiance: nine spherical harmonics, or a cube of {IRRADIANCE_SIDE} texels a side.",
            choices=("sh", "cube"),
            sweep=("sh", "cube"),
        ),
        Knob(
            "compensation",
            "none",
            "What single scattering loses between microfacets is given back, as irradiance (Fdez-Agüera 2019).",
            choices=tuple(COMPENSATIONS),
            sweep=tuple(COMPENSATIONS),
        ),
        Knob(
            "grain",
            "round",
            "An anisotropic lobe is looked up as a round one of its solid angle, or as one of the roughness across the "
            "grain about a bent normal (McAuley 2015; Khronos' glTF Sample Viewer).",
            choices=("round", "bent"),
            sweep=("round", "bent"),
        ),
    ),
    # Where there is a map it is what engines do, and taken before a constant; elsewhere it is not needed.
    rank=-1,
    channels=("position", "normal", "roughness", "base_color", "metallic", "specular", *COAT, *GRAIN, *SHEEN),
    unneeded=same_everywhere,
    defines=defines,
)
