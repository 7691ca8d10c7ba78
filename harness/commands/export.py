"""`lightmeter export SCENE`: what another engine needs to draw it."""

import argparse
import json
from pathlib import Path

from lightmeter import options
from lightmeter.failures import UsageError


def add_options(parser: argparse.ArgumentParser) -> None:
    """Scene, output."""
    options.add_scene(parser)
    parser.add_argument("-o", "--output", metavar="DIR", help="the folder (default lightmeter-out/SCENE-export)")
    options.add_json(parser)


def run(args: argparse.Namespace) -> int:
    """Write the files, say which."""
    size = options.size(args.size)
    from lightmeter.exporting import export

    scene = options.scene(args)
    target = Path(args.output or f"lightmeter-out/{scene.name}-export")
    source = Path(args.scene)
    if source.is_file() and source.resolve().parent == target.resolve():
        raise UsageError(f"{target}: the scene's own files could be overwritten here; name another folder with -o")
    folder = options.output_folder(target)
    exported = export(scene, size, folder)
    files = [str(path.relative_to(folder)) for path in exported.files]
    for note in exported.notes:
        options.say(note)
    if args.json:
        facts = {
            "scene": scene.name,
            "size": list(size),
            "folder": str(folder),
            "files": files,
            "notes": list(exported.notes),
        }
        print(json.dumps(facts, indent=2, ensure_ascii=False))
        return 0
    print(f"{scene.name}, {size[0]}×{size[1]}: {', '.join(files)}\nfolder: {folder}")
    return 0
