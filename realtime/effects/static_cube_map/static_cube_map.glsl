// The cube map by direction.
#include "reflections.glsl"
#include "cube_maps.glsl"

vec3 seen_along(Surface surface, vec3 direction) {
    return from_cube(0, direction);
}

vec3 indirect(Surface surface) {
    return reflected(surface);
}
