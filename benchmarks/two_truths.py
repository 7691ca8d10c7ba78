"""How wrong is Cook-Torrance, with and without compensation, against either truth of rough surfaces?

    python benchmarks/two_truths.py [--size 128] [--spp 64]

The error of its light at the G-buffer's points, and of the whole frame, in `metal-rough-grid`; the result goes to
docs/shading-models.md.
"""

import os

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import argparse

from lightmeter.groundtruth.scattering import SCATTERINGS
from lightmeter.groundtruth.store import Store
from lightmeter.measuring import Question, answers
from lightmeter.options import Budget
from lightmeter.progress import silent
from lightmeter.realtime.device import Device
from lightmeter.realtime.discovery import effects
from lightmeter.realtime.display import display_transform
from lightmeter.realtime.graph import Choice, compile_plan
from lightmeter.realtime.renderer import Renderer
from lightmeter.reports.significant import show_measurement
from lightmeter.scenes.load import load
from lightmeter.sides import Sides, effect_sides
from lightmeter.truth import Truth

COMPENSATIONS = {"none": "none", "turquin": "Turquin's scale", "kulla_conty": "Kulla-Conty's lobe"}
METRICS = ("nrmse", "relative_bias", "flip")


def main() -> None:
    """Measure, and print a row per truth and compensation as Markdown."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--size", type=int, default=128)
    parser.add_argument("--spp", type=int, default=64)
    options = parser.parse_args()
    scene, size, device = load("metal-rough-grid"), (options.size, options.size), Device()
    print("| compensation | truth | nrmse of its light | bias of its light | FLIP of the frame |")
    print("| --- | --- | ---: | ---: | ---: |")
    for scattering in SCATTERINGS:
        truth = Truth(scene, size, Budget(options.spp), store=Store(), scattering=scattering)
        for compensation, words in COMPENSATIONS.items():
            choice = Choice(settings={"cook_torrance": {"compensation": compensation}})
            plan = compile_plan(scene, effects(), choice)
            renderer = Renderer(device, plan, size)
            direct = effect_sides(renderer, truth, silent, only=("cook_torrance",))["cook_torrance"]
            frame = Sides([renderer.render().radiance], list(truth.reference.batches))
            questions = {"direct": Question(METRICS, direct), "frame": Question(("flip",), frame, bounds=True)}
            found = answers(questions, display_transform(plan), silent)
            cells = [show_measurement(found["direct"][name]) for name in METRICS[:2]]
            cells.append(show_measurement(found["frame"]["flip"]))
            print(f"| {words} | {scattering} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
