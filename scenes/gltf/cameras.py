"""Cameras (glTF 2.0, section 3.10)."""

import numpy as np

from lightmeter.scenes.errors import SceneError, nearest, shown
from lightmeter.scenes.framing import clipping_distances, rigid
from lightmeter.scenes.gltf.document import Node
from lightmeter.scenes.gltf.source import Source
from lightmeter.scenes.model import Camera, Shape

Placed = tuple[int, Node, np.ndarray]


def choose(source: Source, placed: list[Placed], asked: str | int | None) -> Placed | None:
    """The node whose camera is used: the one asked for, by its name or number, else the first; None: no camera.

    Cameras count in the order of the file's `cameras`; a name is the camera's or its node's.

    Raises:
        SceneError: a node names a camera that is not there, or the one asked for is not there.
    """
    cameras = source.document.cameras
    named: list[tuple[Placed, set[str]]] = []
    for number, (index, node, _) in sorted(enumerate(placed), key=lambda item: (item[1][1].camera, item[0])):
        camera = source.get("cameras", cameras, node.camera or 0, f"nodes[{index}].camera")
        named.append((placed[number], {camera.name, node.name} - {""}))
    if asked is not None:
        for number, (found, names) in enumerate(named):
            if asked in names or str(asked) == str(number):
                return found
        every = sorted({name for _, names in named for name in names} | {str(i) for i in range(len(named))})
        raise SceneError(
            f"there is no camera {shown(asked)}",
            where=source.where,
            remedy=nearest(str(asked), every) or "the file has no camera in its scene",
        )
    if len(named) > 1:
        titles = [min(names) if names else str(number) for number, (_, names) in enumerate(named)]
        source.note(f"of {len(named)} cameras ({', '.join(titles[:8])}), the first is used")
    return named[0][0] if named else None


def read_camera(source: Source, chosen: Placed, shapes: list[Shape]) -> Camera:
    """The camera at a node; its node's scale is ignored, and so is its aspect ratio.

    A perspective camera without `zfar` gets one behind everything.

    Raises:
        SceneError: its node has no direction.
    """
    index, node, world = chosen
    part = source.document.cameras[node.camera or 0]
    matrix = rigid(world, source.at(f"nodes[{index}]"))
    name = part.name or node.name or f"camera {node.camera}"
    if part.type == "perspective":
        assert part.perspective is not None
        lens = part.perspective
        far = lens.zfar or max(clipping_distances(shapes, matrix)[1], 2 * lens.znear)
        return Camera(name, matrix, yfov=lens.yfov, near=lens.znear, far=far)
    assert part.orthographic is not None
    flat = part.orthographic
    near = flat.znear or 1e-4 * flat.zfar
    return Camera(name, matrix, ymag=abs(flat.ymag), near=near, far=flat.zfar)
