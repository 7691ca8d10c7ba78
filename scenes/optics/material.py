"""glTF 2.0's metallic-roughness material (specification, Appendix B), the one both sides mean.

f = mix(dielectric, metal, metallic) with dielectric = (1 − F_d)·base/π + F_d·D·V, F_d from F0 = 0.04·specular to
F90 = specular (KHR_materials_specular), and metal = F_m·D·V, F_m from base to 1. Schlick's F is linear in F0 and F90,
so that f = (1 − F_d)·c_diff/π + F·D·V with c_diff = base·(1 − metallic) and F of the mixed F0 and F90. `specular` = 0
makes a dielectric Lambert's. The sample code that the specification had until 2024 dimmed the diffuse part by the mixed
F, which is another material between 0 and 1 (KhronosGroup/glTF, issue 2386).

One rule for back-facing directions: light is reflected only between directions on the shading normal's side of the
surface, n·v > 0 and n·l > 0, else f = 0. `double_sided` turns the normal to the viewer's side first.
"""

from collections.abc import Callable
from dataclasses import dataclass

from . import arrays as xp
from . import microfacet
from .arrays import Array
from .frames import basis

PI = 3.141592653589793
DIELECTRIC_F0 = 0.04


@dataclass(frozen=True)
class MaterialPoint:
    """A material's parameters at points: `base_color` (3, N), the others (N,), 0…1."""

    base_color: Array
    metallic: Array
    roughness: Array
    specular: Array

    @property
    def diffuse(self) -> Array:
        """c_diff: reflectance of the Lambert base before Fresnel."""
        return self.base_color * (1 - self.metallic)

    @property
    def f0(self) -> Array:
        """Reflectance at normal incidence."""
        return xp.mix(DIELECTRIC_F0 * self.specular, self.base_color, self.metallic)

    @property
    def f90(self) -> Array:
        """Reflectance at grazing incidence."""
        return xp.mix(self.specular, 1.0, self.metallic)

    @property
    def alpha(self) -> Array:
        """GGX's α."""
        return microfacet.alpha_from_roughness(self.roughness)


def evaluate(point: MaterialPoint, n: Array, v: Array, l: Array) -> Array:  # noqa: E741 (l: light, as in the field)
    """f(v, l)·(n·l) in 1/sr: what a unit of irradiance across l turns into, as radiance towards v."""
    n_dot_v, n_dot_l = xp.dot(n, v), xp.dot(n, l)
    lit = (n_dot_v > 0) & (n_dot_l > 0)
    n_dot_h, sin2_h, v_dot_h = microfacet.half_cosines(n, v, l)
    d = microfacet.d_ggx(n_dot_h, sin2_h, point.alpha)
    visible = microfacet.v_smith_ggx_correlated(xp.maximum(n_dot_v, 1e-7), xp.maximum(n_dot_l, 1e-7), point.alpha)
    fresnel = microfacet.f_schlick(v_dot_h, point.f0, point.f90)
    value = (lambert(point, v_dot_h) + fresnel * (d * visible)) * n_dot_l
    return xp.where(lit, value, 0 * value)


def lambert(point: MaterialPoint, v_dot_h: Array) -> Array:
    """f of the Lambert base, 1/sr: what the dielectric's facet between v and l lets through, (1 − F_d)·c_diff/π."""
    above = microfacet.f_schlick(v_dot_h, DIELECTRIC_F0 * point.specular, point.specular)
    return (1 - above) * point.diffuse * (1 / PI)


def specular_probability(point: MaterialPoint, n_dot_v: Array) -> Array:
    """How often sampling picks the specular lobe: its share of a cheap estimate of both lobes' albedos."""
    fresnel = luminance(microfacet.f_schlick(xp.maximum(n_dot_v, 0.0), point.f0, point.f90))
    diffuse = luminance(point.diffuse) * (1 - fresnel)
    share = fresnel / xp.maximum(fresnel + diffuse, 1e-7)
    # Never below a tenth while the lobe is there: rough lobes hold light far from the mirror direction too.
    return xp.where(fresnel > 0, xp.clip(share, 0.1, 1.0), 0 * share)


def pdf(point: MaterialPoint, n: Array, v: Array, l: Array) -> Array:  # noqa: E741
    """Density of `sample` over directions l, 1/sr; 0 below the horizon."""
    n_dot_v, n_dot_l = xp.dot(n, v), xp.dot(n, l)
    lit = (n_dot_v > 0) & (n_dot_l > 0)
    n_dot_h, sin2_h, _ = microfacet.half_cosines(n, v, l)
    alpha = point.alpha
    d = microfacet.d_ggx(n_dot_h, sin2_h, alpha)
    # Density of visible normals over h, times dh/dl = 1/(4 v·h): G1·D/(4 n·v) (Heitz 2018, eq. 17).
    a2 = alpha * alpha
    g1_over_4nv = 0.5 / xp.maximum(n_dot_v + xp.sqrt(n_dot_v * n_dot_v * (1 - a2) + a2), 1e-30)
    share = specular_probability(point, n_dot_v)
    value = share * (g1_over_4nv * d) + (1 - share) * (n_dot_l * (1 / PI))
    return xp.where(lit, value, 0 * value)


def luminance(color: Array) -> Array:
    """Rec. 709 luminance of a linear colour."""
    return 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2]


def sample(point: MaterialPoint, n: Array, v: Array, u: tuple[Array, Array, Array], vector: Callable) -> Array:
    """A direction l with density `pdf`, for u uniform in [0, 1)³; may fall below the horizon, where pdf is 0.

    `vector` builds a vector from x, y, z.
    """
    s, t = basis(n, vector)
    local_v = vector(xp.dot(s, v), xp.dot(t, v), xp.maximum(xp.dot(n, v), 1e-6))
    h = microfacet.sample_visible_normal(local_v, point.alpha, u[1], u[2], vector)
    mirrored = 2 * xp.dot(local_v, h) * h - local_v
    radius = xp.sqrt(u[1])
    sin_phi, cos_phi = xp.sincos(2 * PI * u[2])
    cosine = vector(radius * cos_phi, radius * sin_phi, xp.sqrt(xp.maximum(1 - u[1], 0.0)))
    local = xp.where(u[0] < specular_probability(point, xp.dot(n, v)), mirrored, cosine)
    return xp.normalize(local[0] * s + local[1] * t + local[2] * n)
