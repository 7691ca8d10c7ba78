// The cube map by where a ray leaves the box.
#include "reflections.glsl"
#include "cube_maps.glsl"
#include "cube_box.glsl"
uniform vec3 box_low;
uniform vec3 box_high;

vec3 seen_along(Surface surface, vec3 direction) {
    return from_cube(0, towards_wall(surface.position, direction, box_low, box_high, cube_centres[0]));
}

vec3 indirect(Surface surface) {
    return reflected(surface);
}
