// What is around a solid, as if it were infinitely far away.
#ifdef SURROUNDED_BY_MAP
#include "environment_map.glsl"
vec3 seen_behind(vec3 direction) {
    return environment_towards(direction);
}
#else
uniform vec3 environment_radiance;
vec3 seen_behind(vec3 _direction) {
    return environment_radiance;
}
#endif

#ifdef SURROUNDED_BY_SCENE
#define CUBES 1
#include "cube_maps.glsl"
uniform sampler2D around_places; // w = 1 where a surface is seen

vec3 seen_around(vec3 direction) {
    bool surface = textureLod(around_places, place_in_cube(0, direction), 0.0).w > 0.5;
    return surface ? from_cube(0, direction) : seen_behind(direction);
}
#else
vec3 seen_around(vec3 direction) {
    return seen_behind(direction);
}
#endif
