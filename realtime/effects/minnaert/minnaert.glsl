// Radiance reflected from one punctual light, without its shadow.
#include "brdf.glsl"
#include "punctual.glsl"
uniform float exponent;

// f·(n·l), 1/sr (Minnaert 1941).
vec3 minnaert(vec3 base_color, float k, vec3 n, vec3 v, vec3 l) {
    float n_dot_v = dot(n, v);
    float n_dot_l = dot(n, l);
    if (n_dot_v <= 0.0 || n_dot_l <= 0.0) return vec3(0.0);
    return base_color * (1.0 / PI) * pow(max(n_dot_v, 1e-7) * max(n_dot_l, 1e-7), k - 1.0) * n_dot_l;
}

vec3 direct(Surface surface) {
    vec3 to_light;
    float received = received_at(surface.position, to_light);
    return light_power * received * minnaert(surface.base_color, exponent, surface.normal, surface.view, to_light);
}
