"""Light that bounces on a rough surface until it leaves it, with random numbers (Heitz et al. 2016).

The truth "multiscatter" of a material is glTF's with its specular part replaced by the whole random walk on GGX's
microsurface (`scenes/optics/microsurface.py`): f = Lambert's base + Σ_k specular of k bounces. One bounce *is* the
closed form of single scattering, height-correlated Smith. Each facet reflects by the material's own Schlick; where
dielectric and metal are mixed, so are their walks, as glTF mixes the two. What a dielectric's facet lets through goes
to the base as ever, (1 − F_d(v·h))·c_diff/π: light that the base sends back does not meet facets again.

There is no closed form. `leaving` is a walk: its direction has the density of what mirrors would send back, its weight
is what the facets left of it. `towards` is an unbiased estimate of f·cos of two bounces or more in a given direction:
each facet of a walk from the viewer sends to the light what its phase function says, as far as nothing is above it
(the paper's stochastic evaluation). That alone has rare and huge values on smooth surfaces, where what one facet sends
is narrow. So half of the walks go from the light to the viewer: what both find is one set of paths, as the
model is reciprocal path by path, and each path is weighed by how likely either is to find it (Veach & Guibas 1995).
"""

from lightmeter.groundtruth.variant import dr, mi
from lightmeter.scenes.optics import material as optics
from lightmeter.scenes.optics import microfacet, microsurface
from lightmeter.scenes.optics.frames import basis
from lightmeter.scenes.optics.material import MaterialPoint

MOST = 100
"""Bounces after which a walk is given up; of a white surface of α = 1 less than one in 10⁶ is."""


class Noise:
    """Random numbers of a lane, from what tells the lane apart.

    Args:
        *told: Floats or UInt32s; lanes that agree in all their bits are given the same numbers. They are hashed two at
            a time (Zafar, Olano and Curtis 2010); eight rounds leave no trace of likeness (see `wavefront.ROUNDS`).
    """

    def __init__(self, *told):
        a, b = mi.UInt32(0x9E3779B9), mi.UInt32(0x7F4A7C15)
        bits = [dr.reinterpret_array(mi.UInt32, mi.Float(x)) if not isinstance(x, mi.UInt32) else x for x in told]
        bits += [mi.UInt32(0)] * (len(bits) % 2)
        for x, y in zip(bits[::2], bits[1::2], strict=True):
            a, b = mi.sample_tea_32(a ^ x, b ^ y, 8)
        high, low = mi.sample_tea_32(b, a, 8)
        self.generator = mi.PCG32(1, (mi.UInt64(a) << 32) | mi.UInt64(b), (mi.UInt64(high) << 32) | mi.UInt64(low))


def evaluate(point: MaterialPoint, normal, view, light, noise: Noise):
    """An unbiased estimate of f·cos (Color3f, 1/sr), and `density`."""
    value = optics.evaluate(point, normal, view, light) + towards(point, normal, view, light, noise)
    return value, density(point, normal, view, light)


def sample(point: MaterialPoint, normal, view, u, noise: Noise):
    """A direction from the material.

    Args:
        u: three Floats, uniform in [0, 1).

    Returns:
        direction (Vector3f), weight (Color3f) and `density`; weight and density are 0 below the horizon. E[weight·g] is
        ∫f·cos·g for any g: with chance s a walk, whose own weight is divided by s, else the base, drawn by the cosine.
    """
    above = dr.dot(normal, view) > 0
    share = _walks(point, dr.dot(normal, view))
    walked, walk_weight = leaving(point, normal, view, noise, mi.Point2f(u[1], u[2]))
    s, t = basis(normal, mi.Vector3f)
    local = mi.warp.square_to_cosine_hemisphere(mi.Point2f(u[1], u[2]))
    scattered = local.x * s + local.y * t + local.z * normal
    _, _, v_dot_h = microfacet.half_cosines(normal, view, scattered)
    base_weight = optics.lambert(point, v_dot_h) * optics.PI
    walks = u[0] < share
    light = dr.select(walks, walked, scattered)
    weight = dr.select(walks, walk_weight / dr.maximum(share, 0.1), base_weight / dr.maximum(1 - share, 1e-7))
    likely = density(point, normal, view, light)
    kept = above & (likely > 0)
    return light, dr.select(kept, weight, 0), dr.select(kept, likely, 0)


def density(point: MaterialPoint, normal, view, light):
    """Float, 1/sr: about how densely `sample` draws; 0 below the horizon and nowhere else.

    The walk's own density is as unknown as its lobe. This one serves to weigh samples of two strategies against each
    other and nothing else: each strategy by itself is unbiased, and for any q the weights p²/(p² + q²) and q²/(p² + q²)
    add up to 1 in every direction, so that the sum of both is unbiased whatever q. With q near the real density it is
    also quiet (Veach 1997, section 9.2). The part of the walks beyond the first bounce, 0.59·α of them, is taken for
    Lambert's.
    """
    beyond = 0.59 * point.alpha
    cosine = dr.maximum(dr.dot(normal, light), 0) * dr.inv_pi
    return dr.select(
        dr.dot(normal, view) > 0, (1 - beyond) * optics.pdf(point, normal, view, light) + beyond * cosine, 0
    )


def _walks(point: MaterialPoint, n_dot_v):
    """How often `sample` walks: as single scattering picks its lobe, but never not at all where F may be above 0."""
    return dr.select(point.f90 > 0, dr.clip(optics.specular_probability(point, n_dot_v), 0.1, 1), 0)


def leaving(point: MaterialPoint, normal, view, noise: Noise, u):
    """A walk from the viewer until it leaves.

    Args:
        normal, view: Vector3f, unit; the walk means nothing where the view is below the surface.
        u: Point2f, chooses the first facet; the rest comes from `noise`.

    Returns:
        direction (Vector3f, world) and weight (Color3f; f·cos over the density of such walks; 0 if it was given up).
    """
    s, t = basis(normal, mi.Vector3f)
    direction, weight, _ = _walk(point, _local(view, s, t, normal), noise, u, None)
    return dr.normalize(direction.x * s + direction.y * t + direction.z * normal), weight


def towards(point: MaterialPoint, normal, view, light, noise: Noise):
    """Color3f, 1/sr: an estimate of f·cos of two bounces or more; 0 unless view and light are above the surface."""
    s, t = basis(normal, mi.Vector3f)
    above = (dr.dot(normal, view) > 0) & (dr.dot(normal, light) > 0)
    first = mi.Point2f(noise.generator.next_float32(), noise.generator.next_float32())
    v, l = _local(view, s, t, normal), _local(light, s, t, normal)  # noqa: E741
    forth = noise.generator.next_float32() < 0.5
    sent = _walk(point, dr.select(forth, v, l), noise, first, dr.select(forth, l, v))[2]
    # A walk from the light estimates f·(n·v); each of the two is taken half the time.
    return dr.select(above, 2 * sent * dr.select(forth, 1, l.z / v.z), 0)


def _local(direction, s, t, normal):
    up = dr.maximum(dr.dot(normal, direction), 1e-6)
    return dr.normalize(mi.Vector3f(dr.dot(s, direction), dr.dot(t, direction), up))


def _walk(point: MaterialPoint, view, noise: Noise, start_u, light):
    """The walk in the surface's own frame: where it left to, its weight, and what it sent `light` (None: not asked).

    What was sent is weighed against the same path from the other end (the balance heuristic). A path's contribution
    over its density is what the last facet sends, `there`; from the other end it is what the first facet sends to the
    viewer, `back`. So there·back/(there + back) is what either adds, and one narrow facet alone does not make it large.
    """
    alpha = mi.Float(point.alpha)
    metal, gloss = mi.Color3f(point.base_color), mi.Float(point.specular)

    def mix(dielectric, metallic):
        return (1 - point.metallic) * dielectric + point.metallic * metallic

    def reflectances(cosine):
        dielectric = microfacet.f_schlick(cosine, optics.DIELECTRIC_F0 * gloss, gloss)
        return dielectric, microfacet.f_schlick(cosine, metal, mi.Color3f(1))

    def seen_from(facing, outside, below):
        density, cosine = microsurface.mirrored(facing, outside, alpha, mi.Vector3f)
        return density * dr.power(below, microsurface.lambda_ggx(outside.z, alpha)), cosine

    def bounce(direction, below, dielectric, metallic, sent, back, generator, count, going):
        leaves, below = microsurface.next_height(direction.z, below, alpha, generator.next_float32())
        going &= ~leaves
        facing = -direction
        if light is not None:
            there, cosine = seen_from(facing, light, below)
            of_dielectric, of_metal = reflectances(cosine)
            # 0 at the first facet, whose part has a closed form: `back` is not known before it.
            share = there * back / dr.maximum(there + back, 1e-20)
            sent += dr.select(going, mix(dielectric * of_dielectric, metallic * of_metal) * share, 0)
        u1 = dr.select(count == 0, start_u.x, generator.next_float32())
        u2 = dr.select(count == 0, start_u.y, generator.next_float32())
        facet = microfacet.sample_visible_normal(facing, alpha, u1, u2, mi.Vector3f)
        cosine = dr.dot(facing, facet)
        of_dielectric, of_metal = reflectances(cosine)
        dielectric = dr.select(going, dielectric * of_dielectric, dielectric)
        metallic = dr.select(going, metallic * of_metal, metallic)
        direction = dr.select(going, dr.normalize(2 * cosine * facet - facing), direction)
        if light is not None:
            first = seen_from(direction, view, below)[0] * (light.z / view.z)
            back = dr.select(count == 0, first, back)
        count = dr.select(going, count + 1, count)
        return direction, below, dielectric, metallic, sent, back, generator, count, going & (count <= MOST)

    weights = mi.Float(1), mi.Color3f(1), mi.Color3f(0)
    start = (-view, mi.Float(1), *weights, mi.Float(0), noise.generator, mi.UInt32(0), mi.Bool(True))
    end = dr.while_loop(start, lambda *state: state[-1], bounce, label="walk on the microsurface")
    direction, _, dielectric, metallic, sent, _, noise.generator, count, _ = end
    return direction, dr.select(count <= MOST, mix(dielectric, metallic), 0), sent
