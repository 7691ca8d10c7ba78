"""`lightmeter reference SCENE`: the truth alone, as a folder of EXR batches."""

import argparse
import json
from pathlib import Path
from typing import Any

from lightmeter import options
from lightmeter.progress import progress_bar


def add_options(parser: argparse.ArgumentParser) -> None:
    """Scene, budget, output."""
    options.add_scene(parser)
    options.add_budget(parser)
    options.add_truth(parser)
    parser.add_argument(
        "--true-surface",
        action="store_true",
        help="of the shapes' true surface: what `compare --reference` needs with an effect that draws another, such as "
        "flat_shading",
    )
    parser.add_argument("-o", "--output", metavar="DIR", help="the folder (default lightmeter-out/SCENE-reference)")
    options.add_store(parser)
    options.add_json(parser)


def run(args: argparse.Namespace) -> int:
    """Render what the store lacks, write the folder, say what it holds."""
    size, budget = options.size(args.size), options.budget(args)
    from lightmeter.groundtruth import folder as reference_folder
    from lightmeter.groundtruth.store import Store
    from lightmeter.scenes.true_surface import true_surface
    from lightmeter.truth import Truth

    scene = options.scene(args)
    scene = true_surface(scene) if args.true_surface else scene
    target = options.output_folder(args.output or f"lightmeter-out/{scene.name}-reference")
    store = None if args.no_store else Store(say=options.say)
    with progress_bar() as report:
        how = {"store": store, "scattering": args.truth, "report": report, "say": options.say}
        truth = Truth(scene, size, budget, args.seed, **how)
        reference, doubt = truth.reference, truth.doubt
        written = reference_folder.save(target, scene, reference)
    facts = _facts(scene.name, size, reference, target, written) | {"doubt": doubt}
    print(json.dumps(facts, indent=2, ensure_ascii=False) if args.json else _sentences(facts))
    if reference.nonfinite:
        options.say(f"{reference.nonfinite} pixels of the reference are not finite; nothing can be measured against it")
    if doubt:
        options.say(doubt)
    return 0


def _facts(scene: str, size: tuple[int, int], reference, folder: Path, written: int) -> dict[str, Any]:
    """What the folder holds, as the JSON document."""
    batches = len(reference.batches)
    return {
        "scene": scene,
        "size": list(size),
        "spp": reference.spp * batches,
        "batches": batches,
        "spp_per_batch": reference.spp,
        "seed": reference.seed,
        "truth": reference.scattering,
        "seconds": round(reference.seconds, 3),
        "reused": reference.reused,
        "nonfinite": reference.nonfinite,
        "bytes": written,
        "folder": str(folder),
    }


def _sentences(facts: dict[str, Any]) -> str:
    from lightmeter.quantities import show_bytes

    width, height = facts["size"]
    return (
        f"{facts['scene']}, {width}×{height}: {facts['spp']} samples per pixel in {facts['batches']} batches, "
        f"{facts['seconds']:.1f} s of rendering\n"
        f"reused {facts['reused']} of {facts['batches']} batches from the store\n"
        f"pixels that are not finite: {facts['nonfinite']}\n"
        f"reference: {facts['folder']} ({show_bytes(facts['bytes'])})"
    )
