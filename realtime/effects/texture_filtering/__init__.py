"""Texture lookup by the hardware's filters: mipmaps, nearest or bilinear, anisotropy."""

from lightmeter.scenes.model import Scene

from ...effect import Effect, Knob


def unneeded(scene: Scene) -> str:
    """Why the scene does not need it."""
    return "" if any(shape.material.textures for shape in scene.shapes) else "the scene has no textures"


EFFECT = Effect(
    name="texture_filtering",
    terms=("material",),
    summary="Textures are looked up with their samplers' filters and mipmaps, in 8 bits where the file has 8.",
    unneeded=unneeded,
    citation="Williams 1983, Pyramidal Parametrics (mipmaps); glTF 2.0, 3.8.4 (samplers)",
    knobs=(
        Knob(
            "filter",
            "sampler",
            "As the file's samplers say, or one filter for every texture.",
            choices=("sampler", "nearest", "linear", "linear_mipmap_linear"),
            sweep=("nearest", "linear", "linear_mipmap_linear"),
        ),
        Knob(
            "anisotropy",
            1.0,
            "Largest anisotropy of the filter's footprint; 1 is none.",
            low=1.0,
            high=16.0,
            sweep=(1.0, 4.0, 16.0),
        ),
    ),
)
