"""The smooth surface of a dielectric solid: what it mirrors, refracts, and what its inside absorbs.

A path through a solid ends each of its segments there on the solid's own surface: what the inside has absorbed on it
is taken off where the segment ends (Beer and Lambert).
"""

from lightmeter.groundtruth import surface
from lightmeter.groundtruth.variant import dr, mi
from lightmeter.scenes.optics import dielectric


def choose(normal, face, view, eta, number):
    """Mirror or refract, by chance.

    Args:
        normal, face: Vector3f, unit, on the viewer's side; where the shading normal sends light to the wrong side of
            the face, the face's stands in.
        view: to the viewer, unit.
        eta: index beyond the surface over that on the viewer's side.
        number: Float in 0…1.

    Returns:
        (direction, whether it is mirrored, the chance of it). Its weight is 1 if mirrored, else 1/eta².
    """

    def both(n):
        cosine = dr.minimum(dr.dot(n, view), 1.0)
        return cosine, 2 * cosine * n - view, dielectric.refracted(n, view, cosine, eta)

    cosine, mirrored, refracted = both(normal)
    sound = (cosine > 0) & (dr.dot(mirrored, face) > 0) & (dr.dot(refracted, face) < 0)
    n = dr.select(sound, normal, face)
    cosine, mirrored, refracted = both(n)
    share = dielectric.reflectance(dr.maximum(cosine, 0.0), eta)
    mirrors = number < share
    return dr.select(mirrors, mirrored, refracted), mirrors, dr.select(mirrors, share, 1 - share)


class GlassBSDF(mi.BSDF):
    """The surface of one solid; front outside.

    Args:
        ior: of the inside.
        absorption: of the inside, RGB, over a length of 1 in the world's frame.
    """

    def __init__(self, ior: float, absorption: tuple[float, float, float]):
        super().__init__(mi.Properties())
        self.tables = None
        self._ior, self._absorption = mi.Float(ior), mi.Color3f(*absorption)
        dr.make_opaque(self._ior, self._absorption)
        sides = mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide
        self.m_components = [
            mi.BSDFFlags.DeltaReflection | sides,
            mi.BSDFFlags.DeltaTransmission | sides | mi.BSDFFlags.NonSymmetric,
        ]
        self.m_flags = int(self.m_components[0]) | int(self.m_components[1])

    def sample(self, ctx, si, sample1, sample2, active=True):
        """Mirrored or refracted, with what the inside left of the segment that ends here."""
        outside = mi.Frame3f.cos_theta(si.wi) > 0
        side = dr.select(outside, mi.Float(1), -1)
        normal = side * surface.at_hit(self.tables, si, frozenset(), active).normal
        eta = dr.select(outside, self._ior, dr.rcp(self._ior))
        direction, mirrors, chance = choose(normal, side * mi.Vector3f(si.n), si.to_world(si.wi), eta, sample1)
        bs = dr.zeros(mi.BSDFSample3f)
        bs.wo, bs.pdf = si.to_local(direction), chance
        bs.eta = dr.select(mirrors, 1.0, eta)
        bs.sampled_type = dr.select(
            mirrors, mi.UInt32(+mi.BSDFFlags.DeltaReflection), mi.UInt32(+mi.BSDFFlags.DeltaTransmission)
        )
        bs.sampled_component = dr.select(mirrors, mi.UInt32(0), mi.UInt32(1))
        left = dr.select(outside, mi.Color3f(1), dr.exp(-self._absorption * si.t))
        weight = left * dr.select(mirrors, 1.0, dr.rcp(dr.square(eta)))
        return bs, dr.select(active, weight, 0)

    def eval(self, ctx, si, wo, active=True):
        """Nothing: the directions have no extent."""
        return mi.Color3f(0)

    def pdf(self, ctx, si, wo, active=True):
        """Likewise."""
        return mi.Float(0)

    def eval_pdf(self, ctx, si, wo, active=True):
        """Likewise."""
        return mi.Color3f(0), mi.Float(0)

    def eval_pdf_sample(self, ctx, si, wo, sample1, sample2, active=True):
        """`eval_pdf` and `sample`."""
        return mi.Color3f(0), mi.Float(0), *self.sample(ctx, si, sample1, sample2, active)

    def eval_null_transmission(self, si, active=True):
        """No straight way leads through."""
        return mi.Color3f(0)

    def traverse(self, callback):
        """Nothing is differentiated."""

    def to_string(self):
        """For messages."""
        return f"GlassBSDF[ior={self._ior[0]:g}]"
