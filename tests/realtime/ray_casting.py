"""Ray casting in float64, written from the conventions of `scenes.model` alone: it shares no code with the renderer."""

import numpy as np

from lightmeter.scenes.model import Camera, Mesh


def rays(camera: Camera, size: tuple[int, int], offset=(0.0, 0.0)) -> tuple[np.ndarray, np.ndarray]:
    """Origins and directions (H, W, 3) through the pixels' centres, moved `offset` pixels right and down.

    The direction's length is such that the parameter t counts depth in metres along the camera's axis.
    """
    width, height = size
    columns = (np.arange(width) + 0.5 + offset[0]) / width
    rows = (np.arange(height) + 0.5 + offset[1]) / height
    x, y = np.meshgrid((2 * columns - 1) * width / height, 1 - 2 * rows)
    right, up, back, position = camera.matrix[:3].T
    plane = x[..., None] * right + y[..., None] * up
    if camera.yfov is not None:
        return np.broadcast_to(position, plane.shape), np.tan(camera.yfov / 2) * plane - back
    return position + camera.ymag * plane, np.broadcast_to(-back, plane.shape)


def cast(mesh: Mesh, origins: np.ndarray, directions: np.ndarray):
    """Nearest hits: position (H, W, 3), triangle (H, W) or −1, and barycentric weights (H, W, 3).

    Also the margin (H, W): how far, as a share of the triangle, the hit lies from the nearest edge. Rays that graze
    an edge may go either way in float32.
    """
    shape = origins.shape[:-1]
    o, d = origins.reshape(-1, 3), directions.reshape(-1, 3)
    nearest = np.full(len(o), np.inf)
    triangle = np.full(len(o), -1)
    weights = np.zeros((len(o), 3))
    margin = np.full(len(o), np.inf)
    a, b, c = (mesh.positions[mesh.triangles[:, i]].astype(np.float64) for i in range(3))
    for index in range(len(a)):
        e1, e2 = b[index] - a[index], c[index] - a[index]
        p = np.cross(d, e2)
        det = p @ e1
        safe = np.where(det == 0, 1e-300, det)
        s = o - a[index]
        u = np.sum(s * p, axis=1) / safe
        q = np.cross(s, e1)
        v = np.sum(d * q, axis=1) / safe
        t = q @ e2 / safe
        inside = np.minimum(np.minimum(u, v), 1 - u - v)
        close = (det != 0) & (t > 0)
        margin = np.where(close & (t < nearest * (1 + 1e-9)), np.minimum(margin, np.abs(inside)), margin)
        better = close & (inside >= 0) & (t < nearest)
        nearest[better], triangle[better] = t[better], index
        weights[better] = np.stack([1 - u - v, u, v], axis=1)[better]
    position = o + np.where(np.isfinite(nearest), nearest, 0)[:, None] * d
    return position.reshape(*shape, 3), triangle.reshape(shape), weights.reshape(*shape, 3), margin.reshape(shape)
