"""`python -m lightmeter.candidates.rendering NAME …`: calls a registered renderer, in a process of its own.

A renderer that crashes, hangs or brings its own OpenGL then does lightmeter no harm, and is timed like any command.
"""

import sys
from pathlib import Path

from lightmeter.candidates.obtaining import Job, find_renderer


def main(words: list[str]) -> None:
    """Call the renderer; its exceptions end the process with their traceback, which the command's message shows."""
    name, gltf, camera_json, environment, width, height, image, scene = words
    job = Job(
        gltf=Path(gltf),
        camera_json=Path(camera_json),
        environment=Path(environment) if environment else None,
        size=(int(width), int(height)),
        image=Path(image),
        side_file=Path(image).with_suffix(".json"),
        scene=scene,
    )
    find_renderer(name).load()(job)


if __name__ == "__main__":
    main(sys.argv[1:])
