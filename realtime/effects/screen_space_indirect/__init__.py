"""Screen-space indirect light: what the camera sees of lit surfaces shines on what stands beside them."""

from ...effect import Effect, Knob, Knobs


def defines(knobs: Knobs) -> dict[str, object]:
    """Counts of loops."""
    return {"SLICES": int(knobs["slices"]), "STEPS": int(knobs["steps"]), "TILE": int(knobs["tile"])}


EFFECT = Effect(
    name="screen_space_indirect",
    terms=("indirect",),
    summary="In slices around the direction to the viewer, each place on the screen that rises above all before it "
    "shines with what is lit there, over the angle by which it rises. One bounce, onto the diffuse base.",
    citation="Jimenez et al. 2016, Practical Realtime Strategies for Accurate Indirect Occlusion, eq. 7 (a slice's "
    "cosine-weighted arc); Mayaux 2018, Horizon-Based Indirect Lighting; Ritschel, Grosch & Seidel 2009, Approximating "
    "Dynamic Global Illumination in Image Space (what a bounce on the screen misses)",
    knobs=(
        Knob("slices", 2, "Directions on the screen, each taken both ways.", low=1, high=32, sweep=(1, 2, 4, 8)),
        Knob("steps", 12, "Places along each way, nearer ones closer.", low=1, high=256, sweep=(4, 8, 16, 32, 64)),
        Knob(
            "radius",
            1.0,
            "How far the places reach.",
            unit="of the picture's height",
            low=0.01,
            high=4.0,
            sweep=(0.1, 0.25, 0.5, 1.0),
        ),
        Knob(
            "tile",
            4,
            "Side of a square of pixels that look in other directions each, and over which like pixels are averaged.",
            unit="pixels",
            low=1,
            high=8,
            sweep=(1, 2, 4, 8),
        ),
    ),
    rank=6,
    channels=("position", "normal", "roughness", "base_color", "metallic", "specular"),
    reads_scattered=True,
    defines=defines,
)
