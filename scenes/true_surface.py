"""The true surface of a scene, and coarser ones of the same shapes.

A shape that has a form (`shapes/forms.py`) can be drawn at any tessellation. The truth is traced from triangles too:
from `FINE` steps of it, with the true normals at the vertices. A cylinder's wall is then at most 1 − cos(π/512) =
1.9·10⁻⁵ of its radius inside the true one, a sphere's face 1 − cos(√2·π/512) = 3.8·10⁻⁵, and a round silhouette lacks
1 − sin(2π/512)/(2π/512) = 2.5·10⁻⁵ of its area.
"""

from dataclasses import replace
from weakref import WeakKeyDictionary, WeakSet

from lightmeter.scenes.dressing import dressed
from lightmeter.scenes.model import Mesh, Scene

FINE = 512
"""Steps around an axis of what stands for the true surface."""

MOST_FORMS = 24
"""Up to so many shapes have `FINE` steps; in scenes of more they have half as many for each fourfold number, so that
the triangles stay about as many."""

_true: WeakKeyDictionary[Scene, Scene] = WeakKeyDictionary()
_are_true: WeakSet[Scene] = WeakSet()


def has_true_surface(scene: Scene) -> bool:
    """Whether any shape is more than its triangles."""
    return any(shape.form is not None for shape in scene.shapes)


def is_true_surface(scene: Scene) -> bool:
    """Whether the scene is one that `true_surface` made."""
    return scene in _are_true


def true_surface(scene: Scene) -> Scene:
    """The scene with its true surface; the scene itself where it has that already, or where no shape has a form."""
    if is_true_surface(scene) or not has_true_surface(scene):
        return scene
    if scene not in _true:
        steps, forms = FINE, sum(shape.form is not None for shape in scene.shapes)
        while forms > MOST_FORMS and steps > 64:
            steps, forms = steps // 2, forms // 4
        _true[scene] = tessellated(scene, steps)
        _are_true.add(_true[scene])
    return _true[scene]


def tessellated(scene: Scene, steps: int, smooth: bool = True) -> Scene:
    """The scene with every form at so many steps; shapes without a form stay as they are.

    Args:
        steps: around an axis, 3…1024.
        smooth: whether vertices have the true normals; else triangles have their own.
    """
    meshes: dict[object, Mesh] = {}
    shapes = []
    for shape in scene.shapes:
        if shape.form is None:
            shapes.append(shape)
            continue
        if shape.form not in meshes:
            mesh = shape.form.mesh(steps)
            meshes[shape.form] = mesh if smooth else replace(mesh, normals=None)
        shapes.append(replace(shape, mesh=dressed(meshes[shape.form], shape.material)[0]))
    return replace(scene, shapes=tuple(shapes))
