#include "solid_front.glsl"

vec3 transmission(Surface surface) {
    if (surface.ior <= 0.0) return vec3(0.0);
    float mirrored;
    vec3 through = seen_around(entering(surface, mirrored));
    return behind_front(surface, through, mirrored);
}
