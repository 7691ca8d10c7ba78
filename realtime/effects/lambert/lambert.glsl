// Radiance reflected from one punctual light, without its shadow.
#include "brdf.glsl"
#include "punctual.glsl"

// f·(n·l), 1/sr.
vec3 lambert(vec3 base_color, vec3 n, vec3 l) {
    return base_color * (1.0 / PI) * max(dot(n, l), 0.0);
}

vec3 direct(Surface surface) {
    vec3 to_light;
    float received = received_at(surface.position, to_light);
    return light_power * received * lambert(surface.base_color, surface.normal, to_light);
}
