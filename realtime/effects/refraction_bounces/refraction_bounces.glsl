// The planes first: a file that both include must not lie within the other's `#ifdef`.
#include "solid_planes.glsl"
#include "solid_front.glsl"

// Everything that comes out of a solid towards where `inside` came from; all positions are from the solid's middle.
vec3 from_within(int solid, vec3 start, vec3 inside, float ior, vec3 absorption) {
    vec3 total = vec3(0.0), share = vec3(1.0);
    for (int i = 0; i < BOUNCES; ++i) {
        float way;
        vec3 outward = exit_plane(solid, start, inside, way).xyz;
        start += way * inside;
        share *= exp(-absorption * way);
        float cosine = clamp(dot(outward, inside), 0.0, 1.0);
        float mirrored = dielectric_reflectance(cosine, 1.0 / ior);
        if (mirrored < 1.0)
            total += share * (1.0 - mirrored) * seen_around(refracted(-outward, -inside, cosine, 1.0 / ior));
        share *= mirrored;
        inside = reflect(inside, outward);
    }
    return total;
}

vec3 transmission(Surface surface) {
    if (surface.ior <= 0.0) return vec3(0.0);
    float mirrored;
    vec3 inside = entering(surface, mirrored);
    vec3 through = vec3(0.0);
    for (int i = 0; i < SOLIDS; ++i) {
        vec3 place = surface.position;
        if (all(greaterThanEqual(place, solid_low[i])) && all(lessThanEqual(place, solid_high[i])))
            through = from_within(i, place - solid_middle[i], inside, surface.ior, surface.absorption);
    }
    return behind_front(surface, through, mirrored);
}
