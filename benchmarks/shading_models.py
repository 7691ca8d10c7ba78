"""How wrong is each shading model, over roughness, for plastic and metal?

    python benchmarks/shading_models.py [--plot FILE.png] [--json FILE] [--only MODEL …]

Each model's own GLSL is evaluated at given points over all directions of light, viewer and normal, against the oracle
of `direct`; the result goes to docs/shading-models.md.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import argparse
import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path

import numpy as np
from lit_points import Configurations, shaded, stage, truth
from rich.console import Console

from lightmeter.device import fingerprint
from lightmeter.groundtruth.world import World
from lightmeter.metrics.comparison import Comparison
from lightmeter.metrics.registry import measure_all
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.display import display_transform
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.scenes.load import load
from lightmeter.scenes.optics import conductors, fresnel, microfacet
from lightmeter.scenes.optics.albedo import mean_albedo
from lightmeter.scenes.optics.furnace import COARSE, light_from_everywhere
from lightmeter.scenes.optics.microsurface import walk

MODELS: dict[str, tuple[str, dict]] = {
    "Lambert": ("lambert", {}),
    "Minnaert, k = 0.8": ("minnaert", {}),
    "Oren-Nayar, full": ("oren_nayar", {"form": "full"}),
    "Oren-Nayar, short": ("oren_nayar", {"form": "qualitative"}),
    "Oren-Nayar, Fujii": ("oren_nayar", {"form": "fujii"}),
    "Oren-Nayar, EON": ("oren_nayar", {"form": "eon"}),
    "Phong, 1975": ("phong", {"normalisation": "none", "cosine": False}),
    "Phong, energy": ("phong", {}),
    "Blinn-Phong, 1/π": ("blinn_phong", {"normalisation": "none", "cosine": False}),
    "Blinn-Phong, (s+8)/8π": ("blinn_phong", {"normalisation": "usual"}),
    "Blinn-Phong, exact": ("blinn_phong", {}),
    "Cook-Torrance": ("cook_torrance", {}),
    "D: Beckmann": ("cook_torrance", {"distribution": "beckmann"}),
    "D: Blinn": ("cook_torrance", {"distribution": "blinn"}),
    "G: separable Smith": ("cook_torrance", {"masking": "smith_separable"}),
    "G: Schlick, k = α/2": ("cook_torrance", {"masking": "schlick_half"}),
    "G: Schlick, k = (r+1)²/8": ("cook_torrance", {"masking": "schlick_remapped"}),
    "G: fast V": ("cook_torrance", {"masking": "smith_fast"}),
    "G: implicit": ("cook_torrance", {"masking": "implicit"}),
    "F: exact dielectric": ("cook_torrance", {"fresnel": "dielectric"}),
    "F: exact conductor": ("cook_torrance", {"fresnel": "conductor"}),
    "F: none": ("cook_torrance", {"fresnel": "none"}),
    "with Turquin's scale": ("cook_torrance", {"compensation": "turquin"}),
    "with Kulla-Conty's lobe": ("cook_torrance", {"compensation": "kulla_conty"}),
}
MATERIALS = {"plastic": (0.5, 0.0), "metal": (0.9, 1.0)}
"""Grey base colour, metalness."""
ROUGHNESS = (0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0)
ALBEDO_ROUGHNESS = (0.1, 0.3, 0.5, 0.7, 1.0)
ALBEDO_COSINES = (1.0, 0.8, 0.6, 0.4, 0.2, 0.1)
SIDE = 96
IRRADIANCE = 3.0
ENERGY_ROUGHNESS = (0.2, 0.4, 0.6, 0.8, 1.0)
ENERGY_F0 = (1.0, 0.9, 0.5)
PLOTTED = (
    "Lambert",
    "Oren-Nayar, EON",
    "Phong, energy",
    "Blinn-Phong, exact",
    "D: Beckmann",
    "G: Schlick, k = (r+1)²/8",
    "G: fast V",
    "F: exact dielectric",
)


@dataclass(frozen=True)
class Errors:
    """Of one model on one material, at each of `ROUGHNESS`.

    Attributes:
        misplaced: Σ|L − L*|/ΣL* over all directions: 0 is right, black is 1.
        bias: Σ(L − L*)/ΣL*.
        nrmse: RMSE over the mean.
        flip: of a lit ball's picture.
        one_sided: Σ|f(v, l) − f(l, v)|/Σf, worst roughness: what is not reciprocal.
    """

    model: str
    material: str
    misplaced: list[float]
    bias: list[float]
    nrmse: list[float]
    flip: list[float]
    one_sided: float


@dataclass(frozen=True)
class Albedo:
    """The largest albedo of a model with base colour 1 over roughness and angle, and where."""

    model: str
    material: str
    largest: float
    roughness: float
    cosine: float


def gauss(count: int, high: float) -> tuple[np.ndarray, np.ndarray]:
    """Nodes and weights over 0…high."""
    nodes, weights = np.polynomial.legendre.leggauss(count)
    return (nodes + 1) * high / 2, weights * high / 2


class AllDirections:
    """A ball under parallel light, the light from anywhere: the mean over all its pictures.

    The normals lie around the half vector, their angles θ spread as asinh(θ/α) is, so that a lobe of any width is met.
    A picture's pixels count with n·v, the light's directions with sin ψ.
    """

    apart, rings, turns = 16, 64, 32

    def __init__(self) -> None:
        apart, apart_weight = gauss(self.apart, np.pi)
        along, along_weight = gauss(self.rings, 1.0)
        turn = (np.arange(self.turns) + 0.5) * np.pi / self.turns
        roughness = np.array(ROUGHNESS)[:, None, None, None]
        width = microfacet.alpha_from_roughness(roughness)
        span = np.arcsinh(np.pi / 2 / width)
        theta = width * np.sinh(along[:, None] * span)
        solid = width * np.cosh(along[:, None] * span) * span * along_weight[:, None] * np.sin(theta)
        self.shape = len(ROUGHNESS), self.apart, self.rings, self.turns
        theta, turned, psi, rough, solid, psi_weight = (
            np.broadcast_to(a, self.shape).ravel()
            for a in (
                theta, turn, apart[:, None, None], roughness, solid, (apart_weight * np.sin(apart))[:, None, None],
            )
        )  # fmt: skip
        normal = np.stack([np.sin(theta) * np.cos(turned), np.sin(theta) * np.sin(turned), np.cos(theta)], axis=-1)
        self.at = Configurations(normal, psi, rough)
        self.to_view = np.maximum(np.sum(normal * self.at.view, axis=-1), 0)
        self.solid = (solid * psi_weight).reshape(self.shape)
        self.weight = self.solid * self.to_view.reshape(self.shape)

    def over(self, values: np.ndarray) -> np.ndarray:
        """Σ of values (N,) by weight, for each roughness."""
        return np.sum(values.reshape(self.shape) * self.weight, axis=(1, 2, 3))

    def one_sided(self, reflected: np.ndarray) -> float:
        """How much of f differs when light and viewer change places: the normal's turn φ becomes π − φ."""
        there = (reflected * self.to_view).reshape(self.shape)
        apart, total = (np.sum(v * self.solid, axis=(1, 2, 3)) for v in (np.abs(there - there[..., ::-1]), there))
        return float(np.max(apart / total))


class Ball:
    """A lit ball of each roughness, seen as a picture: SIDE² pixels, light from 45° above the viewer."""

    def __init__(self) -> None:
        axis = (np.arange(SIDE) + 0.5) / SIDE * 2 - 1
        x, y = np.meshgrid(axis, -axis)
        self.inside = x**2 + y**2 < 1
        self.display = display_transform(compile_plan(load("control"), effects()))
        normal = np.stack([x, y, np.sqrt(np.maximum(1 - x**2 - y**2, 0))], axis=-1)[self.inside]
        count = len(normal)
        view = np.broadcast_to([0.0, 0.0, 1.0], (count, 3))
        light = np.broadcast_to(np.array([-0.5, 0.5, np.sqrt(0.5)]), (count, 3))
        parts = [Configurations.of(normal, view, light, np.full(count, r)) for r in ROUGHNESS]
        self.at = Configurations(*(np.concatenate([getattr(p, f.name) for p in parts]) for f in fields(Configurations)))

    def pictures(self, reflected: np.ndarray) -> np.ndarray:
        """(roughness, SIDE, SIDE, 3) radiance."""
        out = np.zeros((len(ROUGHNESS), SIDE, SIDE, 3), np.float32)
        out[:, self.inside] = IRRADIANCE * reflected.reshape(len(ROUGHNESS), -1, 1)
        return out

    def flip(self, reflected: np.ndarray, exact: np.ndarray) -> list[float]:
        """FLIP of each picture, under the display transform."""
        return [
            measure_all(("flip",), Comparison(a, b[None]), display=self.display)["flip"].value
            for a, b in zip(self.pictures(reflected), self.pictures(exact), strict=True)
        ]


class Furnace:
    """Light from everywhere on a point seen from a few angles, for the directional albedo."""

    def __init__(self, roughness: Sequence[float], cosine: Sequence[float]) -> None:
        lit = [light_from_everywhere(c, COARSE) for c in cosine]
        light = np.stack([directions.T for directions, _ in lit])
        view = np.array([[[np.sqrt(1 - c * c), 0.0, c]] for c in cosine])
        self.weight = np.stack([weight for _, weight in lit])
        self.shape = len(roughness), *self.weight.shape
        up = np.array([0.0, 0.0, 1.0])
        normal, view, light = (np.broadcast_to(d, (*self.shape, 3)).reshape(-1, 3) for d in (up, view, light))
        rough = np.broadcast_to(np.reshape(roughness, (-1, 1, 1)), self.shape).ravel()
        self.at = Configurations.of(normal, view, light, rough)

    def albedo(self, reflected: np.ndarray) -> np.ndarray:
        """(roughness, cosine)."""
        return np.sum(reflected.reshape(self.shape) * self.weight, axis=-1)


def main() -> None:
    """Measure, print the tables as Markdown, draw the plot."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", choices=MODELS, nargs="+", default=list(MODELS), metavar="MODEL")
    parser.add_argument("--times", action="store_true", help="time every model at 512², and nothing else")
    parser.add_argument("--plot", type=Path, metavar="PNG")
    parser.add_argument("--json", type=Path, metavar="FILE")
    options = parser.parse_args()
    device, console = Device(), Console(stderr=True)
    if options.times:
        print(table(["model", "ms", "beside Cook-Torrance"], times(device, options.only)))
        return
    errors, albedos = [], []
    everywhere, ball, world = AllDirections(), Ball(), World.of(stage())
    furnace = Furnace(ALBEDO_ROUGHNESS, ALBEDO_COSINES)
    for material, (base_color, metallic) in MATERIALS.items():
        exact = [truth(world, view.at, base_color, metallic) for view in (everywhere, ball)]
        for model in options.only:
            console.print(f"{material}: {model}", style="dim")
            effect, knobs = MODELS[model]
            found = [shaded(device, view.at, base_color, metallic, effect, knobs) for view in (everywhere, ball)]
            errors.append(judged(model, material, everywhere, ball, found, exact))
            white = furnace.albedo(shaded(device, furnace.at, 1.0, metallic, effect, knobs))
            albedos.append(brightest(model, material, white))
    print(document(errors, albedos))
    print(f"\n{table(['F0, roughness', *COMPENSATED, 'random walk'], energy(device))}")
    machine = fingerprint(device.renderer, device.version)
    if options.json:
        kept = {"device": machine, "roughness": ROUGHNESS}
        kept |= {"errors": [asdict(e) for e in errors], "albedos": [asdict(a) for a in albedos]}
        options.json.write_text(json.dumps(kept, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    if options.plot:
        plot(errors, options.plot)


def judged(model: str, material: str, everywhere: AllDirections, ball: Ball, found, exact) -> Errors:
    """The errors of what a model found, against what is exact, over all directions and of the ball."""
    difference, total = found[0] - exact[0], everywhere.over(exact[0])
    area = everywhere.over(np.ones_like(difference))
    return Errors(
        model,
        material,
        misplaced=(everywhere.over(np.abs(difference)) / total).tolist(),
        bias=(everywhere.over(difference) / total).tolist(),
        nrmse=(np.sqrt(everywhere.over(difference**2) * area) / total).tolist(),
        flip=ball.flip(found[1], exact[1]),
        one_sided=everywhere.one_sided(found[0]),
    )


def brightest(model: str, material: str, albedo: np.ndarray) -> Albedo:
    """The largest of (roughness, cosine)."""
    row, column = np.unravel_index(albedo.argmax(), albedo.shape)
    return Albedo(model, material, float(albedo.max()), ALBEDO_ROUGHNESS[row], ALBEDO_COSINES[column])


def document(errors: list[Errors], albedos: list[Albedo]) -> str:
    """The tables as Markdown."""
    shown = [0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0]
    columns = [ROUGHNESS.index(r) for r in shown]
    parts = []
    for material in MATERIALS:
        for what in ("misplaced", "bias", "flip"):
            rows = [e for e in errors if e.material == material]
            head = [f"{material}, {what}", *(f"{r:g}" for r in shown)]
            sign = "+" if what == "bias" else ""
            cells = [[e.model, *(f"{getattr(e, what)[c]:{sign}.3f}" for c in columns)] for e in rows]
            parts.append(table(head, cells))
    both = {(e.model, e.material): e for e in errors}
    cells = []
    for a in albedos:
        if a.material == "metal":
            other = next(o for o in albedos if o.model == a.model and o.material == "plastic")
            one_sided = max(both[a.model, m].one_sided for m in MATERIALS)
            cells.append([a.model, f"{one_sided:.1e}", *(place(x) for x in (other, a))])
    parts.append(table(["model", "not reciprocal", "white plastic's largest albedo", "white metal's"], cells))
    parts.append(table(["metal", "F0", *FITS], metals()))
    return "\n\n".join(parts)


def times(device: Device, models: list[str]) -> list[list[str]]:
    """The shading passes of metal-rough-grid's three lights at 512², in rounds over all models.

    A round's times were taken under like conditions: the ratio is the median of the rounds' ratios.
    """
    scene, size = load("metal-rough-grid"), (512, 512)
    renderers = {}
    for model in dict.fromkeys(["Cook-Torrance", *models]):
        effect, knobs = MODELS[model]
        plan = compile_plan(scene, effects(), Choice(only=(effect,), settings={effect: knobs}))
        renderers[model] = Renderer(device, plan, size)
        renderers[model].draw()
    rounds: dict[str, list[float]] = {model: [] for model in renderers}
    for _ in range(ROUNDS):
        for model, renderer in renderers.items():
            passes = renderer.record(1, 0).passes
            rounds[model].append(sum(taken[0] for _, effect, taken in passes if effect))
    beside = np.array(rounds["Cook-Torrance"])
    return [
        [model, f"{np.median(taken):.1f}", f"{np.median(np.array(taken) / beside):.2f}"]
        for model, taken in rounds.items()
    ]


ROUNDS = 15
COMPENSATED = {"single": "none", "Turquin": "turquin", "Kulla-Conty": "kulla_conty"}
RAYS = 400_000


def energy(device: Device) -> list[list[str]]:
    """What metals return of light from everywhere: by one bounce, compensated, and by a walk on the microsurface."""
    nodes, weights = gauss(10, 1.0)
    furnace = Furnace(ENERGY_ROUGHNESS, nodes)
    rows = []
    for f0 in ENERGY_F0:
        found = []
        for compensation in COMPENSATED.values():
            knobs = {"compensation": compensation}
            albedo = furnace.albedo(shaded(device, furnace.at, f0, 1.0, "cook_torrance", knobs))
            found.append(mean_albedo(albedo, nodes, weights))
        for index, roughness in enumerate(ENERGY_ROUGHNESS):
            walked, sure = walked_albedo(f0, roughness)
            cells = [f"{values[index]:.3f}" for values in found]
            rows.append([f"{f0:g}, {roughness:g}", *cells, f"{walked:.3f} ± {sure:.3f}"])
    return rows


def walked_albedo(f0: float, roughness: float) -> tuple[float, float]:
    """The mean weight of rays from everywhere, and half its 95 % interval."""
    rng = np.random.default_rng(0)
    cosine, turn = np.sqrt(rng.random(RAYS)), 2 * np.pi * rng.random(RAYS)
    sine = np.sqrt(1 - cosine**2)
    v = np.stack([sine * np.cos(turn), sine * np.sin(turn), cosine])
    alpha = float(microfacet.alpha_from_roughness(roughness))
    weight = walk(v, alpha, lambda c: microfacet.f_schlick(c, f0, 1.0)[None], rng).weight[0]
    return float(weight.mean()), float(1.96 * weight.std() / np.sqrt(RAYS))


def place(albedo: Albedo) -> str:
    """An albedo and where it is found."""
    return f"{albedo.largest:.3f} (roughness {albedo.roughness:g}, n·v {albedo.cosine:g})"


FITS = ("Schlick", "n, k of RGB", "Gulbrandsen, tint 0", "0.5", "1", "nearest tint")


def metals() -> list[list[str]]:
    """The largest error of RGB reflectances over the angle, against the metal's spectrum."""
    cosine = np.cos(np.radians(np.linspace(0, 90, 901)))
    rows = []
    for metal in conductors.METALS:
        exact = conductors.rgb_reflectance(metal, cosine)
        f0 = np.clip(exact[:, :1], 0, 1)
        n, k = (a[:, None] for a in conductors.rgb_index(metal))
        tints = np.linspace(0, 1, 101)
        tinted = [np.abs(fresnel.f_conductor(cosine, *fresnel.complex_index_of(f0, t)) - exact).max() for t in tints]
        found = [
            np.abs(microfacet.f_schlick(cosine, f0, 1.0) - exact).max(),
            np.abs(fresnel.f_conductor(cosine, n, k) - exact).max(),
            *(tinted[i] for i in (0, 50, 100)),
        ]
        nearest = int(np.argmin(tinted))
        color = ", ".join(f"{c:.3f}" for c in exact[:, 0])
        rows.append([metal, color, *(f"{x:.3f}" for x in found), f"{tinted[nearest]:.3f} ({tints[nearest]:.2f})"])
    return rows


def table(head: list[str], rows: list[list[str]]) -> str:
    """A Markdown table; all but the first column to the right."""
    lines = [head, ["---", *["---:"] * (len(head) - 1)], *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def plot(errors: list[Errors], path: Path) -> None:
    """Misplaced light over roughness, for both materials (matplotlib comes with VTK)."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(1, 2, figsize=(10, 3.6), sharey=True, layout="constrained")
    for axis, material in zip(axes, MATERIALS, strict=True):
        for error in errors:
            if error.material == material and error.model in PLOTTED:
                axis.plot(ROUGHNESS, error.misplaced, marker=".", label=error.model)
        axis.set(title=material, xlabel="roughness", yscale="log", ylim=(1e-3, 4))
        axis.grid(alpha=0.3, which="both")
    axes[0].set_ylabel("light in the wrong place, Σ|L − L*| / ΣL*")
    figure.legend(*axes[1].get_legend_handles_labels(), fontsize=8, loc="outside right center")
    figure.savefig(path, dpi=90)


if __name__ == "__main__":
    main()
