// The front of a dielectric solid, which every technique begins and ends with.
#include "dielectric.glsl"
#include "seen_around.glsl"

// The direction that the view takes inside, and the share that the front mirrors.
vec3 entering(Surface surface, out float mirrored) {
    float cosine = min(dot(surface.normal, surface.view), 1.0);
    mirrored = dielectric_reflectance(cosine, surface.ior);
    return refracted(surface.normal, surface.view, cosine, surface.ior);
}

// What comes through, and before it what the front mirrors.
vec3 behind_front(Surface surface, vec3 through, float mirrored) {
    return mix(through, seen_around(reflect(-surface.view, surface.normal)), mirrored);
}
