"""Nodes and where they stand (glTF 2.0, section 3.5)."""

from collections.abc import Iterator

import numpy as np

from lightmeter.scenes.errors import SceneError
from lightmeter.scenes.gltf.document import Node
from lightmeter.scenes.gltf.source import Source


def placed_nodes(source: Source) -> Iterator[tuple[int, Node, np.ndarray]]:
    """Every node of the file's scene with its (4, 4) local-to-world matrix, parents before children.

    Raises:
        SceneError: a node is missing, has two parents, is its own ancestor, or stands nowhere finite.
    """
    nodes = source.document.nodes
    seen: set[int] = set()
    stack = [(index, np.eye(4), "scene") for index in reversed(_roots(source))]
    while stack:
        index, parent, place = stack.pop()
        node = source.get("nodes", nodes, index, place)
        here = f"nodes[{index}]"
        if index in seen:
            raise SceneError(
                "the node is reached twice",
                where=source.at(here),
                expected="a tree: one parent each, and no cycle",
                actual=f"again from {place}",
            )
        seen.add(index)
        with np.errstate(all="ignore"):
            world = parent @ local_matrix(node)
        if not np.isfinite(world).all() or np.abs(world).max() > 1e30:
            raise SceneError("the node stands nowhere finite", where=source.at(here), actual="an overflow")
        yield index, node, world
        stack += [(child, world, f"{here}.children") for child in reversed(node.children)]


def local_matrix(node: Node) -> np.ndarray:
    """(4, 4) float64: the node's matrix, or translation · rotation · scale."""
    if node.matrix is not None:
        return np.array(node.matrix, dtype=np.float64).reshape(4, 4).T
    out = np.eye(4)
    if node.rotation is not None:
        x, y, z, w = np.array(node.rotation) / np.linalg.norm(node.rotation)
        out[:3, :3] = [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    if node.scale is not None:
        out[:3, :3] *= node.scale
    if node.translation is not None:
        out[:3, 3] = node.translation
    return out


def _roots(source: Source) -> list[int]:
    """The nodes that the scene to show starts from."""
    file = source.document
    if file.scenes or file.scene is not None:
        chosen = file.scene or 0
        if len(file.scenes) > 1:
            source.note(f"of {len(file.scenes)} scenes, number {chosen} is shown")
        return source.get("scenes", file.scenes, chosen, "scene").nodes
    source.note("the file has no scene: every node that is nobody's child is shown")
    children = {child for node in file.nodes for child in node.children}
    return [index for index in range(len(file.nodes)) if index not in children]
