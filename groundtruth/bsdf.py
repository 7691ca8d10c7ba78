"""The scene's material (`scenes/optics/material.py`) as a Mitsuba BSDF.

One instance serves every material of a kind (the texture slots it uses, whether it has an alpha mask); constants come
from the tables by the shape's index, so that a grid of 36 materials is one kernel without 36 virtual functions.

In transport, light is carried only between directions on the same side of the *geometric* face, beside the optics' own
rule for the shading normal; else surfaces with interpolated normals leak light through their backs.
"""

from collections.abc import Set as AbstractSet

from lightmeter.groundtruth import surface
from lightmeter.groundtruth.tables import SLOTS, Tables
from lightmeter.groundtruth.variant import dr, mi
from lightmeter.scenes.model import Shape
from lightmeter.scenes.optics import material as optics

SCATTERING_SLOTS = frozenset(SLOTS) - {"occlusion", "emissive"} | {"color"}
MASK = "mask"


def kind(shape: Shape) -> frozenset[str]:
    """What tells one BSDF instance from another: the slots a material uses, its layers, and "mask"."""
    found = set(shape.material.textures) & SCATTERING_SLOTS | shape.material.layers
    if shape.mesh.colors is not None:
        found.add("color")
    if shape.material.alpha_mode == "mask":
        found.add(MASK)
    return frozenset(found)


class SceneBSDF(mi.BSDF):
    """glTF's metallic-roughness material with `sample`, `eval`, `pdf` and `eval_pdf`.

    Args:
        tables: the scene's; may be set later (the tables need the meshes' ids, the meshes their BSDF).
        kind: see `kind`.
    """

    def __init__(self, kind: AbstractSet[str], tables: Tables | None = None):
        super().__init__(mi.Properties())
        self.tables = tables
        self.slots = frozenset(kind) - {MASK}
        self.masked = MASK in kind
        lobes = mi.BSDFFlags.DiffuseReflection | mi.BSDFFlags.GlossyReflection
        lobes = lobes | mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide | mi.BSDFFlags.SpatiallyVarying
        self.m_components = [lobes]
        if self.masked:
            self.m_components = [lobes, mi.BSDFFlags.Null | mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide]
        flags = 0
        for component in self.m_components:
            flags = flags | int(component)
        self.m_flags = flags

    def _point(self, si, active) -> surface.SurfacePoint:
        return surface.at_hit(self.tables, si, self.slots, active)

    def _frame(self, si, point: surface.SurfacePoint):
        """Shading normal on the viewer's side, direction to the viewer, and whether that side scatters."""
        behind = mi.Frame3f.cos_theta(si.wi) < 0
        double_sided = point.double_sided
        normal = point.normal
        normal = dr.select(behind & double_sided, -normal, normal)
        return normal, si.to_world(si.wi), ~behind | double_sided

    def _material(self, si, point: surface.SurfacePoint) -> optics.MaterialPoint:
        """The parameters, with the layers' normals on the viewer's side."""
        return point.material.turned((mi.Frame3f.cos_theta(si.wi) < 0) & point.double_sided)

    def _carried(self, si, point, scatters, wo, active):
        """Whether transport carries light from `wo` at all."""
        carried = active & scatters & (mi.Frame3f.cos_theta(si.wi) * mi.Frame3f.cos_theta(wo) > 0)
        return carried & point.present if self.masked else carried

    def _eval_pdf(self, si, point, material, frame, wo, active):
        normal, view, scatters = frame
        light = si.to_world(wo)
        carried = self._carried(si, point, scatters, wo, active)
        value = optics.evaluate(material, normal, view, light)
        density = optics.pdf(material, normal, view, light)
        return dr.select(carried, value, 0), dr.select(carried, density, 0)

    def _draw(self, si, point, material, frame, sample1, sample2, active):
        """A direction, its density and its weight."""
        normal, view, _ = frame
        light = optics.sample(material, normal, view, (sample1, sample2.x, sample2.y), mi.Vector3f)
        wo = si.to_local(light)
        value, density = self._eval_pdf(si, point, material, frame, wo, active)
        return wo, density, dr.select(density > 0, value / density, 0)

    def _sample(self, si, point, material, frame, sample1, sample2, active):
        wo, density, weight = self._draw(si, point, material, frame, sample1, sample2, active)
        bs = dr.zeros(mi.BSDFSample3f)
        bs.wo, bs.pdf, bs.eta = wo, density, 1.0
        bs.sampled_type = mi.UInt32(+mi.BSDFFlags.GlossyReflection)
        bs.sampled_component = mi.UInt32(0)
        if self.masked:
            hole = active & ~point.present
            bs.wo = dr.select(hole, -si.wi, bs.wo)
            bs.pdf = dr.select(hole, 1.0, bs.pdf)
            bs.sampled_type = dr.select(hole, mi.UInt32(+mi.BSDFFlags.Null), bs.sampled_type)
            bs.sampled_component = dr.select(hole, mi.UInt32(1), bs.sampled_component)
            weight = dr.select(hole, 1.0, weight)
        return bs, mi.Color3f(weight)

    def sample(self, ctx, si, sample1, sample2, active=True):
        """A direction with density `pdf` and its weight f·cos/pdf; through the holes of a mask, straight on."""
        point = self._point(si, active)
        return self._sample(si, point, self._material(si, point), self._frame(si, point), sample1, sample2, active)

    def eval(self, ctx, si, wo, active=True):
        """f·cos, 1/sr."""
        return self.eval_pdf(ctx, si, wo, active)[0]

    def pdf(self, ctx, si, wo, active=True):
        """Density of `sample` over directions, 1/sr."""
        return self.eval_pdf(ctx, si, wo, active)[1]

    def eval_pdf(self, ctx, si, wo, active=True):
        """`eval` and `pdf`."""
        point = self._point(si, active)
        return self._eval_pdf(si, point, self._material(si, point), self._frame(si, point), wo, active)

    def eval_pdf_sample(self, ctx, si, wo, sample1, sample2, active=True):
        """`eval_pdf` and `sample`, with one look at the textures."""
        point = self._point(si, active)
        material, frame = self._material(si, point), self._frame(si, point)
        value, density = self._eval_pdf(si, point, material, frame, wo, active)
        bs, weight = self._sample(si, point, material, frame, sample1, sample2, active)
        return value, density, bs, weight

    def eval_null_transmission(self, si, active=True):
        """1 in the holes of an alpha mask, else 0."""
        if not self.masked:
            return mi.Color3f(0)
        return dr.select(active & ~self._point(si, active).present, mi.Color3f(1), mi.Color3f(0))

    def traverse(self, callback):
        """Nothing is differentiated."""

    def to_string(self):
        """For messages."""
        return f"SceneBSDF[{', '.join(sorted(self.slots | ({MASK} if self.masked else set())))}]"
