#include "dielectric.glsl"
#include "seen_around.glsl"

vec3 transmission(Surface surface) {
    if (surface.ior <= 0.0) return vec3(0.0);
    float cosine = min(dot(surface.normal, surface.view), 1.0);
    float mirrored = dielectric_reflectance(cosine, surface.ior);
    vec3 through = seen_around(refracted(surface.normal, surface.view, cosine, surface.ior));
    return mix(through, seen_around(reflect(-surface.view, surface.normal)), mirrored);
}
