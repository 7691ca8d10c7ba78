"""Made-up results and pictures that look like a comparison: a ball on a floor under a lamp and a sky."""

import math

import numpy as np

from lightmeter.metrics.measurement import Measurement
from lightmeter.metrics.shadow_error import KINDS, PLACES, ShadowPart
from lightmeter.reports.display_curve import DisplayCurve
from lightmeter.reports.pictures import Pair, flip_error, rms_error, share_map, signed_error
from lightmeter.reports.results import (
    Attribution,
    Candidate,
    Closure,
    Effect,
    FailedCandidate,
    Finding,
    Frame,
    LayerError,
    LeftOut,
    LightShadow,
    NonFinite,
    ObjectError,
    PassTime,
    Player,
    Reference,
    Results,
    Timing,
)

RADIANCE = "W/sr/m²"


def narkowicz_curve() -> DisplayCurve:
    """A tone curve and gamma 2.2, sampled as a frame would give them."""
    x = np.linspace(-12, 8, 321)
    value = 2.0**x
    toned = value * (2.51 * value + 0.03) / (value * (2.43 * value + 0.59) + 0.14)
    return DisplayCurve(tuple(x), tuple(np.clip(toned, 0, 1) ** (1 / 2.2)), "Narkowicz, gamma 2.2")


def ball(size: int, soft: float) -> dict[str, np.ndarray]:
    """Buffers of the scene, each (size, size, 3): visibility's penumbra is `soft` wide."""
    v, u = (np.mgrid[0:size, 0:size] + 0.5) / size
    x, y = 2 * u - 1, 1 - 2 * v
    inside = x**2 + y**2 < 0.36
    normal_z = np.sqrt(np.clip(0.36 - x**2 - y**2, 0, None))
    light = np.array([-0.5, 0.7, 0.55])
    lambert = np.clip((x * light[0] + y * light[1] + normal_z * light[2]) / 0.6, 0, None)
    floor = y < -0.15
    base = np.where(
        inside[..., None], [0.8, 0.32, 0.2], np.where(floor[..., None], [0.45, 0.5, 0.42], [0.2, 0.35, 0.6])
    )
    irradiance = np.where(inside, 3.2 * lambert, np.where(floor, 1.9 * np.exp(-(x**2) - (y + 0.6) ** 2), 0.0))
    distance = np.hypot((x - 0.42) / 1.5, (y + 0.62) * 2.6) - 0.42
    shadow = np.clip(0.5 + distance / max(soft, 1e-4), 0, 1) if soft else (distance > 0) * 1.0
    visibility = np.where(floor & ~inside, shadow, 1.0)
    contact = 1 - 0.75 * np.exp(-np.hypot(x, (y + 0.6) * 2.2) * 3.2)
    sky = np.where(inside | floor, 0.35, 1.0)
    return {
        "direct": base * irradiance[..., None],
        "visibility": np.repeat(visibility[..., None], 3, 2),
        "environment": base * sky[..., None] * [0.8, 0.95, 1.2],
        "occlusion": np.repeat(np.where(inside | floor, contact, 1.0)[..., None], 3, 2),
        "surface": (inside | floor),
    }


def make_pairs(size: int = 96, broken: bool = False) -> list[Pair]:
    """Four pairs; with `broken` the frame holds a few pixels that are not finite."""
    random = np.random.default_rng(5)
    rough, exact = ball(size, 0.0), ball(size, 0.22)

    def noisy(image: np.ndarray, level: float) -> np.ndarray:
        return (image * (1 + level * random.standard_normal(image.shape))).astype(np.float32)

    truth = exact["direct"] * exact["visibility"] + exact["environment"] * exact["occlusion"]
    frame = rough["direct"] * 1.03 * rough["visibility"] + rough["environment"] * 0.92
    highlight = ((np.mgrid[0:size, 0:size] / size - [[[0.36]], [[0.4]]]) ** 2).sum(axis=0)[..., None]
    truth = truth + 30 * np.exp(-highlight * 900)
    frame = (frame + 24 * np.exp(-highlight * 700)).astype(np.float32)
    if broken:
        frame[size // 4, size // 3] = np.nan
        frame[3 * size // 4, size // 2] = [np.inf, 1, 1]
    truth = noisy(truth, 0.01)
    flip = np.clip(np.abs(np.log2((frame + 0.05) / (truth + 0.05))).mean(axis=2) / 2, 0, 1)
    pairs = [
        Pair(
            "frame",
            "Whole frame",
            (),
            frame,
            truth,
            (rms_error(frame, truth, RADIANCE), flip_error(flip), signed_error(frame, truth, RADIANCE)),
            unit=RADIANCE,
            caption="The real-time frame beside the path-traced reference of the same camera.",
        )
    ]
    buffers = [
        ("cook_torrance", "direct", rough["direct"] * 1.03, exact["direct"], RADIANCE, None),
        ("shadow_map", "visibility", rough["visibility"], exact["visibility"], "", exact["surface"]),
        ("constant_ambient", "environment", rough["environment"] * 0.92, exact["environment"], RADIANCE, None),
    ]
    for name, term, tested, true, unit, mask in buffers:
        tested, true = tested.astype(np.float32), noisy(true, 0.004)
        difference = tested - true
        shares = (
            share_map("mse", np.mean(difference * np.abs(difference), axis=2), f"({RADIANCE})²"),
            share_map("flip", np.mean(difference, axis=2)),
        )
        errors = (rms_error(tested, true, unit), signed_error(tested, true, unit), *shares)
        caption = f"The effect's own buffer beside the oracle of {term} at the same points."
        pairs.append(Pair(name, name, (term,), tested, true, errors, unit=unit, caption=caption, mask=mask))
    shown = narkowicz_curve().apply(truth).astype(np.float32)
    other = np.clip(shown**1.02, 0, 1).astype(np.float32)
    pairs.append(Pair("narkowicz", "narkowicz", ("tone",), other, shown, (rms_error(other, shown),), "display"))
    return pairs


# Player: terms, whether an effect approximates them.
PLAYERS = {
    "cook_torrance": (("direct",), True),
    "shadow_map": (("visibility",), True),
    "constant_ambient": (("environment", "indirect"), True),
    "environment_visibility": (("environment_visibility",), False),
    "transmission": (("transmission",), False),
}
# Metric to share, its half-width, removed, its half-width: a row per player.
SHARES = {
    "mse": (
        (-0.00021, 0.00005, -0.00034, 0.00006),
        (0.00262, 0.00012, 0.00248, 0.00013),
        (0.00095, 0.00006, 0.00081, 0.00007),
        (0.00061, 0.0001, 0.00052, 0.00012),
        (0.00002, 0.00009, 0.00003, 0.00011),
    ),
    "flip": (
        (0.0031, 0.0009, 0.0008, 0.0011),
        (0.0341, 0.0012, 0.0302, 0.0014),
        (0.0188, 0.001, 0.016, 0.001),
        (0.012, 0.002, 0.01, 0.002),
        (0.0, 0.0, 0.0, 0.0),
    ),
}
TOTALS = {"mse": (0.00421, 0.00012), "flip": (0.0721, 0.0019)}
UNITS = {"mse": f"({RADIANCE})²", "flip": ""}


def between(value: float, half: float, unit: str = "") -> Measurement:
    """A value with a symmetric interval, as a jackknife gives it."""
    return Measurement(value, value - half, value + half, unit, "U-statistic over 8 batches, jackknife, Student t")


def make_attribution() -> Attribution:
    """Shares to go with `make_results`: one is negative, one is noise, two belong to terms without an effect."""
    players = tuple(
        Player(
            name,
            terms,
            approximated,
            {metric: between(*rows[index][:2], UNITS[metric]) for metric, rows in SHARES.items()},
            {metric: between(*rows[index][2:], UNITS[metric]) for metric, rows in SHARES.items()},
        )
        for index, (name, (terms, approximated)) in enumerate(PLAYERS.items())
    )
    return Attribution(
        total={metric: between(*total, UNITS[metric]) for metric, total in TOTALS.items()},
        residual={
            metric: between(total - sum(player.share[metric].value for player in players), 0.0001, UNITS[metric])
            for metric, (total, _) in TOTALS.items()
        },
        players=players,
        subsets=32,
        exhaustive=True,
        seconds_per_subset={"mse": 0.0123, "flip": 0.21},
    )


def make_objects(count: int = 4) -> tuple[ObjectError, ...]:
    """A floor, a ball, the background, and as many pebbles as it takes; the shares sum to 1."""
    found = [("floor", "concrete", 4120, 0.71), ("ball", "red paint", 2630, 0.24), ("background", "", 1800, -0.01)]
    pebbles = count - len(found)
    found += [(f"pebble {index}", "stone", 40, 0.06 / pebbles) for index in range(pebbles)]
    return tuple(
        ObjectError(
            name,
            material,
            pixels,
            {"rmse": between(0.05 + share / 10, 0.002, RADIANCE), "bias": between(-0.01, 0.001, RADIANCE),
             "flip": Measurement(0.07, 0.066, 0.078)},
            between(share, 0.02),
        )
        for name, material, pixels, share in found
    )  # fmt: skip


def make_shadows() -> tuple[LightShadow, ...]:
    """A sun whose shadow has acne and an edge in the wrong place, and a lamp without an error."""
    kinds = {kind: dict.fromkeys(PLACES, ShadowPart(0, Measurement(0.0, how="no pixel"))) for kind in KINDS}
    sun = {kind: dict(places) for kind, places in kinds.items()}
    sun["dark"] |= {"away": ShadowPart(1234, between(0.62, 0.02)), "edge": ShadowPart(88, between(0.21, 0.01))}
    sun["lit"] |= {"contact": ShadowPart(1, between(0.166, 0.01)), "near": ShadowPart(3, between(0.004, 0.001))}
    lamp = {kind: dict(places) for kind, places in kinds.items()}
    lamp["lit"]["edge"] = ShadowPart(0, Measurement(math.nan))
    return (
        LightShadow("shadow_map", "sun", between(0.0404, 0.001, RADIANCE), sun),
        LightShadow("pcss", "lamp", between(0.0, 0.0, RADIANCE), lamp),
    )


def make_results(size: int = 96, broken: bool = False, scene: str = "ball-on-floor") -> Results:
    """Results to go with `make_pairs`."""

    def noisy(value: float, floor: float) -> Measurement:
        return Measurement(value, value * 0.96, value * 1.01, "", "at the mean of 8 batches", floor, value * 0.98)

    frame = {
        "mse": between(0.00421, 0.00012, f"({RADIANCE})²"),
        "rmse": between(0.06489, 0.0009, RADIANCE),
        "nrmse": between(0.1421, 0.0021),
        "bias": between(-0.0123, 0.0004, RADIANCE),
        "psnr": Measurement(27.31, 27.1, 27.5, "dB", "of the unbiased MSE"),
        "ssim": noisy(0.9312, 0.991),
        "flip": noisy(0.0721, 0.0041),
        "rms_p95": between(0.141, 0.003, RADIANCE),
        "rms_p99": between(0.382, 0.011, RADIANCE),
        "rms_worst_tile": between(0.291, 0.008, RADIANCE),
        "flip_p95": Measurement(0.214, 0.201, 0.219),
        "flip_p99": Measurement(0.433, 0.41, 0.441),
        "flip_worst_tile": Measurement(0.377, 0.36, 0.381),
    }
    if broken:
        frame |= {name: Measurement(math.nan, how="failed: 2 non-finite pixels") for name in ("rmse", "nrmse", "flip")}
    attribution = make_attribution()
    shares = {player.name: player.share for player in attribution.players}
    effects = (
        Effect("cook_torrance", ("direct",), {},
               {"rmse": between(0.0112, 0.0002, RADIANCE), "flip": noisy(0.012, 0.003), "ssim": noisy(0.9921, 0.999)},
               Timing(1.82, 0.04, 40), shares["cook_torrance"]),
        Effect("shadow_map", ("visibility",), {"resolution": 1024, "filter": "pcf3", "bias": 0.0015},
               {"rmse": between(0.0523, 0.0031, RADIANCE), "flip": noisy(0.044, 0.003), "ssim": noisy(0.951, 0.999)},
               Timing(3.41, 0.12, 40), shares["shadow_map"]),
        Effect("constant_ambient", ("environment", "indirect"), {"scale": 1.0},
               {"rmse": between(0.0312, 0.0006, RADIANCE), "flip": noisy(0.025, 0.003), "ssim": noisy(0.97, 0.999)},
               share=shares["constant_ambient"]),
        Effect("narkowicz", ("tone",), {"exposure": 1.0}, {"rmse": Measurement(0.0083, None, None, "code value")},
               Timing(0.31, 0.01, 40)),
    )  # fmt: skip
    return Results(
        scene=scene,
        size=(size, size),
        frame=Frame(frame, Timing(9.87, 0.21, 40)),
        device={
            "cpu": "Some CPU, 2 cores",
            "gl": {"renderer": "llvmpipe (LLVM 19.1.7, 256 bits)", "version": "4.5 (Core Profile) Mesa 25.0"},
            "mitsuba": "3.9.1, llvm_ad_rgb",
            "drjit": "1.5.0",
            "llvm": "19.1.7",
        },
        reference=Reference(512, 8, 14.2, False),
        effects=effects,
        closure=Closure({"nrmse": between(0.0021, 0.0002)}, between(-0.0001, 0.0003)),
        left_out=(
            LeftOut("effect ssao", "the scene has no crevice that the environment reaches"),
            LeftOut("material 'lens', alpha BLEND", "no effect blends; the real-time frame draws it opaque"),
        ),
        nonfinite=NonFinite(2, {}, {"frame": ((size // 3, size // 4), (size // 2, 3 * size // 4))})
        if broken
        else NonFinite(),
        notes=("The scene has no camera: one was framed around its bounds.",),
        not_approximated=("environment_visibility", "transmission"),
        attribution=attribution,
        objects=make_objects(),
        passes=(
            PassTime("gbuffer", "", 2.11, 0.05),
            PassTime("shadow map", "shadow_map", 1.92, 0.08),
            PassTime("shadow lookup", "shadow_map", 1.49, 0.06),
            PassTime("cook_torrance", "cook_torrance", 1.82, 0.04),
            PassTime("compose", "", 0.71, 0.02),
            PassTime("narkowicz", "narkowicz", 0.31, 0.01),
        ),
    )


def make_candidates() -> tuple[Candidate, ...]:
    """Our own frame, an engine with a fault, layers and shares, and one whose time holds its start-up."""

    def metrics(rmse: float, flip: float) -> dict[str, Measurement]:
        return {
            "rmse": Measurement(rmse, rmse * 0.97, rmse * 1.03, RADIANCE),
            "relative_bias": Measurement(-rmse / 2, -rmse * 0.52, -rmse * 0.48),
            "ssim": Measurement(1 - flip, 1 - flip * 1.1, 1 - flip * 0.9),
            "flip": Measurement(flip, flip * 0.95, flip * 1.05, floor=0.0041),
        }

    direct = Player("direct", ("direct",), True, {"mse": Measurement(0.0011, 0.001, 0.0012)}, {})
    rest = Player("rest", (), False, {"mse": Measurement(0.0002, 0.0001, 0.0003)}, {})
    return (
        Candidate(
            "lightmeter",
            "lightmeter",
            metrics(0.081, 0.09),
            Timing(9.87, 0.21, 40),
            "wall time around a finished frame",
            pixels=4000,
        ),
        Candidate(
            "our <engine> & co",
            "command",
            metrics(0.036, 0.05),
            Timing(22.4, 0.9, 20),
            "reported by the engine",
            pixels=4000,
            masked={"unsupported material glass": 80, "background": 16},
            findings=(
                Finding("shift", "shifted by 0.50 pixels right and 0.00 down", {"right": 0.5, "down": 0.0}),
                Finding("exposure", "brighter by a factor of 1.50", {"factor": 1.5}, corrected=True),
            ),
            layers=(
                LayerError("direct", "direct", metrics(0.021, 0.03), 4000),
                LayerError("visibility.0", "visibility", metrics(0.011, 0.02), 4000),
            ),
            attribution=Attribution(
                {"mse": Measurement(0.0013, 0.0012, 0.0014)},
                {"mse": Measurement(0.0, -0.0001, 0.0001)},
                (direct, rest),
                4,
                True,
            ),
            engine="Engine 3.1",
            device="llvmpipe",
            notes=("No indirect light.",),
        ),
        Candidate(
            "slow", "file", metrics(0.02, 0.03), Timing(2400.0, 0.0, 1), "measured around the command", True, 4000
        ),
    )


def make_candidate_pairs(size: int = 96) -> list[Pair]:
    """Pictures to go with `make_candidates`: our frame, two engines' (one with a mask), and one engine's two layers."""
    frame = make_pairs(size)[0]
    rough, exact = ball(size, 0.0), ball(size, 0.22)
    mask = np.ones((size, size), bool)
    mask[: size // 8, size // 2 :] = False
    engines = (("our <engine> & co", np.roll(frame.truth, size // 24, axis=1), mask), ("slow", 1.1 * frame.truth, None))
    pairs = [frame]
    for name, tested, judged in engines:
        flip = np.clip(np.abs(np.log2((tested + 0.05) / (frame.truth + 0.05))).mean(axis=2) / 2, 0, 1)
        errors = (flip_error(flip), rms_error(tested, frame.truth, RADIANCE))
        pairs.append(Pair(name, name, (), tested, frame.truth, errors, unit=RADIANCE, mask=judged))
    for layer, term in (("direct", "direct"), ("visibility.0", "visibility")):
        tested, truth = rough[term].astype(np.float32), exact[term].astype(np.float32)
        name = f"our <engine> & co {layer}"
        pairs.append(Pair(name, name, (term,), tested, truth, (rms_error(tested, truth, RADIANCE),)))
    return pairs


def make_failed() -> tuple[FailedCandidate, ...]:
    """An engine that gave nothing."""
    return (FailedCandidate("broken", "it ended with exit code 1; its last output: no display"),)
