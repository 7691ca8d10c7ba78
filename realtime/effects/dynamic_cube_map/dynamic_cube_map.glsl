// The cube map of the object whose box holds the point.
#include "reflections.glsl"
#include "cube_maps.glsl"
uniform vec3 object_low[CUBES];
uniform vec3 object_high[CUBES];

// Whether a point lies in a box.
bool within(vec3 point, vec3 low, vec3 high) {
    return all(greaterThanEqual(point, low)) && all(lessThanEqual(point, high));
}

vec3 seen_along(Surface surface, vec3 direction) {
    vec3 found = ambient_radiance;
    for (int i = 0; i < CUBES; ++i)
        if (within(surface.position, object_low[i], object_high[i])) found = from_cube(i, direction);
    return found;
}

vec3 indirect(Surface surface) {
    return reflected(surface);
}
