// What is around a solid, as if it were infinitely far away: the environment, whatever stands before it.
#ifdef SURROUNDED_BY_MAP
#include "environment_map.glsl"
vec3 seen_around(vec3 direction) {
    return environment_towards(direction);
}
#else
uniform vec3 environment_radiance;
vec3 seen_around(vec3 _direction) {
    return environment_radiance;
}
#endif
