"""The scene's material as a Mitsuba BSDF whose rough surfaces scatter more than once.

Mitsuba gives `eval` no random numbers, and the lobe has no closed form. What tells one evaluation from another gives
them: the bits of the place, of both directions and of the time. Two paths hardly ever agree in all of these; they are
independent otherwise. `sample` is given numbers, and its walk follows from them.
"""

from lightmeter.groundtruth import microsurface
from lightmeter.groundtruth.bsdf import SceneBSDF
from lightmeter.groundtruth.variant import dr


class MultiscatterBSDF(SceneBSDF):
    """glTF's material with the whole walk on the microsurface (see `microsurface`): `eval` is an unbiased estimate.

    `pdf` is for weighing strategies against each other; `sample`'s weight is exact, and no quotient of the two.
    """

    def _eval_pdf(self, si, point, material, frame, wo, active):
        normal, view, scatters = frame
        noise = microsurface.Noise(*si.p, *si.wi, *wo, si.time)
        value, density = microsurface.evaluate(material, normal, view, si.to_world(wo), noise)
        carried = self._carried(si, point, scatters, wo, active)
        return dr.select(carried, value, 0), dr.select(carried, density, 0)

    def _draw(self, si, point, material, frame, sample1, sample2, active):
        normal, view, scatters = frame
        u = (sample1, sample2.x, sample2.y)
        light, weight, density = microsurface.sample(material, normal, view, u, microsurface.Noise(*u))
        wo = si.to_local(light)
        carried = self._carried(si, point, scatters, wo, active)
        return wo, dr.select(carried, density, 0), dr.select(carried, weight, 0)
