"""glTF 2.0's metallic-roughness material (specification, Appendix B), the one both sides mean.

f = mix(dielectric, metal, metallic) with dielectric = (1 − F_d)·base/π + F_d·D·V, F_d from F0 = 0.04·specular to
F90 = specular (KHR_materials_specular), and metal = F_m·D·V, F_m from base to 1. Schlick's F is linear in F0 and F90,
so that f = (1 − F_d)·c_diff/π + F·D·V with c_diff = base·(1 − metallic) and F of the mixed F0 and F90. `specular` = 0
makes a dielectric Lambert's. The sample code that the specification had until 2024 dimmed the diffuse part by the mixed
F, which is another material between 0 and 1 (KhronosGroup/glTF, issue 2386).

One rule for back-facing directions: light is reflected only between directions on the shading normal's side of the
surface, n·v > 0 and n·l > 0, else f = 0. `double_sided` turns the normal to the viewer's side first. A coat has its
own normal n_c for light (n_c·l > 0 and n_c·v > 0), while n·v > 0 decides for all layers whether a point is seen.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

from . import anisotropy, clear_coat, microfacet, sheen
from . import arrays as xp
from .anisotropy import Grain
from .arrays import Array
from .clear_coat import Coat
from .color import LUMINANCE
from .frames import basis
from .sheen import Sheen

PI = 3.141592653589793
DIELECTRIC_F0 = 0.04


@dataclass(frozen=True)
class MaterialPoint:
    """Parameters at points: `base_color` (3, N), the others (N,), 0…1; a layer that is None is not there."""

    base_color: Array
    metallic: Array
    roughness: Array
    specular: Array
    coat: Coat | None = None
    grain: Grain | None = None
    sheen: Sheen | None = None

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

    def turned(self, over: Array) -> "MaterialPoint":
        """The same with the coat's normal turned to the other side where `over` (N,) says so."""
        if self.coat is None:
            return self
        normal = self.coat.normal
        return replace(self, coat=replace(self.coat, normal=xp.where(over, -normal, normal)))


def evaluate(point: MaterialPoint, n: Array, v: Array, l: Array) -> Array:  # noqa: E741 (l: light, as in the field)
    """f(v, l)·(n·l) in 1/sr: what a unit of irradiance across l turns into, as radiance towards v."""
    value = _base(point, n, v, l)
    if point.sheen is not None:
        value = sheen.over(point.sheen, value, n, v, l)
    if point.coat is None:
        return value
    value = clear_coat.over(point.coat, value, v, l)
    return xp.where(xp.dot(n, v) > 0, value, 0 * value)


def _base(point: MaterialPoint, n: Array, v: Array, l: Array) -> Array:  # noqa: E741
    """f·(n·l) of what lies below coat and sheen."""
    n_dot_v, n_dot_l = xp.dot(n, v), xp.dot(n, l)
    lit = (n_dot_v > 0) & (n_dot_l > 0)
    n_dot_h, sin2_h, v_dot_h = microfacet.half_cosines(n, v, l)
    if point.grain is None:
        d = microfacet.d_ggx(n_dot_h, sin2_h, point.alpha)
        visible = microfacet.v_smith_ggx_correlated(xp.maximum(n_dot_v, 1e-7), xp.maximum(n_dot_l, 1e-7), point.alpha)
        gloss = d * visible
    else:
        gloss = anisotropy.lobe(point.grain, point.alpha, n, v, l)
    fresnel = microfacet.f_schlick(v_dot_h, point.f0, point.f90)
    value = (lambert(point, v_dot_h) + fresnel * gloss) * n_dot_l
    return xp.where(lit, value, 0 * value)


def lambert(point: MaterialPoint, v_dot_h: Array) -> Array:
    """f of the Lambert base, 1/sr: what the dielectric's facet between v and l lets through, (1 − F_d)·c_diff/π."""
    above = microfacet.f_schlick(v_dot_h, DIELECTRIC_F0 * point.specular, point.specular)
    return (1 - above) * point.diffuse * (1 / PI)


def specular_probability(point: MaterialPoint, n_dot_v: Array) -> Array:
    """How often sampling picks the specular lobe: its share of a cheap estimate of both lobes' albedos."""
    fresnel, diffuse = _albedos(point, n_dot_v)
    share = fresnel / xp.maximum(fresnel + diffuse, 1e-7)
    # Never below a tenth while the lobe is there: rough lobes hold light far from the mirror direction too.
    return xp.where(fresnel > 0, xp.clip(share, 0.1, 1.0), 0 * share)


def base_albedo(point: MaterialPoint, n_dot_v: Array) -> Array:
    """A cheap estimate of the luminance that the base reflects."""
    fresnel, diffuse = _albedos(point, n_dot_v)
    return fresnel + diffuse


def _albedos(point: MaterialPoint, n_dot_v: Array) -> tuple[Array, Array]:
    """Cheap estimates of the albedos of the specular and of the diffuse lobe, as luminances."""
    fresnel = luminance(microfacet.f_schlick(xp.maximum(n_dot_v, 0.0), point.f0, point.f90))
    return fresnel, luminance(point.diffuse) * (1 - fresnel)


def pdf(point: MaterialPoint, n: Array, v: Array, l: Array) -> Array:  # noqa: E741
    """Density of `sample` over directions l, 1/sr; 0 below the horizon."""
    density = _base_pdf(point, n, v, l)
    if point.sheen is not None:
        n_dot_v, n_dot_l = xp.dot(n, v), xp.dot(n, l)
        picked = sheen.probability(point.sheen, base_albedo(point, n_dot_v), n_dot_v)
        density = xp.where(n_dot_v > 0, xp.mix(density, sheen.pdf(n_dot_l), picked), 0 * density)
    if point.coat is None:
        return density
    picked = clear_coat.probability(point.coat, base_albedo(point, xp.dot(n, v)), v)
    density = xp.mix(density, clear_coat.pdf(point.coat, v, l), picked)
    return xp.where(xp.dot(n, v) > 0, density, 0 * density)


def _base_pdf(point: MaterialPoint, n: Array, v: Array, l: Array) -> Array:  # noqa: E741
    """Density of `_sample_base`."""
    n_dot_v, n_dot_l = xp.dot(n, v), xp.dot(n, l)
    lit = (n_dot_v > 0) & (n_dot_l > 0)
    if point.grain is None:
        n_dot_h, sin2_h, _ = microfacet.half_cosines(n, v, l)
        mirrored = microfacet.mirrored_density(n_dot_v, microfacet.d_ggx(n_dot_h, sin2_h, point.alpha), point.alpha)
    else:
        mirrored = anisotropy.mirrored_density(point.grain, point.alpha, n, v, l)
    share = specular_probability(point, n_dot_v)
    value = share * mirrored + (1 - share) * (n_dot_l * (1 / PI))
    return xp.where(lit, value, 0 * value)


def luminance(color: Array) -> Array:
    """Rec. 709 luminance of a linear colour."""
    return LUMINANCE[0] * color[0] + LUMINANCE[1] * color[1] + LUMINANCE[2] * color[2]


def sample(point: MaterialPoint, n: Array, v: Array, u: tuple[Array, Array, Array], vector: Callable) -> Array:
    """A direction l with density `pdf`, for u uniform in [0, 1)³; may fall below the horizon, where pdf is 0.

    `vector` builds a vector from x, y, z.
    """
    if point.coat is None:
        return _sample_below(point, n, v, u, vector)
    picked = clear_coat.probability(point.coat, base_albedo(point, xp.dot(n, v)), v)
    # What chooses between coat and base is stretched to choose again below.
    again = (u[0] - picked) / xp.maximum(1 - picked, 1e-7)
    below = _sample_below(point, n, v, (again, u[1], u[2]), vector)
    above = clear_coat.sample(point.coat, v, u[1], u[2], vector)
    # What falls below its own layer's horizon is lost, although the other's may be lower: no density tells of it. −v is
    # below both.
    below = xp.where(xp.dot(n, below) > 0, below, -v)
    above = xp.where(xp.dot(point.coat.normal, above) > 0, above, -v)
    return xp.where(u[0] < picked, above, below)


def _sample_below(point: MaterialPoint, n: Array, v: Array, u: tuple[Array, Array, Array], vector: Callable) -> Array:
    """A direction from what lies below the coat."""
    if point.sheen is None:
        return _sample_base(point, n, v, u, vector)
    n_dot_v = xp.dot(n, v)
    picked = sheen.probability(point.sheen, base_albedo(point, n_dot_v), n_dot_v)
    again = (u[0] - picked) / xp.maximum(1 - picked, 1e-7)
    below = _sample_base(point, n, v, (again, u[1], u[2]), vector)
    return xp.where(u[0] < picked, sheen.sample(n, u[1], u[2], vector), below)


def _sample_base(point: MaterialPoint, n: Array, v: Array, u: tuple[Array, Array, Array], vector: Callable) -> Array:
    """A direction from the specular or the diffuse lobe."""
    if point.grain is None:
        s, t = basis(n, vector)
        along = across = point.alpha
    else:
        s, t = point.grain.direction, xp.cross(n, point.grain.direction)
        along, across = anisotropy.alphas(point.grain, point.alpha)
    local_v = vector(xp.dot(s, v), xp.dot(t, v), xp.maximum(xp.dot(n, v), 1e-6))
    h = microfacet.sample_visible_normal(local_v, along, u[1], u[2], vector, across)
    mirrored = 2 * xp.dot(local_v, h) * h - local_v
    radius = xp.sqrt(u[1])
    sin_phi, cos_phi = xp.sincos(2 * PI * u[2])
    cosine = vector(radius * cos_phi, radius * sin_phi, xp.sqrt(xp.maximum(1 - u[1], 0.0)))
    local = xp.where(u[0] < specular_probability(point, xp.dot(n, v)), mirrored, cosine)
    return xp.normalize(local[0] * s + local[1] * t + local[2] * n)
