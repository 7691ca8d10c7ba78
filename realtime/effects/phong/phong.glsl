// Radiance reflected from one punctual light, without its shadow.
#include "brdf.glsl"
#include "punctual.glsl"
#include "cosine_power.glsl"

// Lafortune & Willems 1994, eq. 6: an albedo of at most 1.
float lafortune(float exponent) {
    return (exponent + 2.0) / (2.0 * PI);
}

float unscaled(float exponent) {
    return 1.0 / PI;
}

// f·(n·l), 1/sr.
vec3 phong(vec3 base_color, float metallic, float roughness, float specular, vec3 n, vec3 v, vec3 l) {
    float n_dot_l = dot(n, l);
    if (dot(n, v) <= 0.0 || n_dot_l <= 0.0) return vec3(0.0);
    float alpha = max(roughness * roughness, MIN_ALPHA);
    float exponent = 0.25 * blinn_exponent(alpha);
    vec3 mirrored = 2.0 * n_dot_l * n - l;
    vec3 beside = cross(mirrored, v);
    float highlight = SCALE(exponent) * cosine_power(dot(mirrored, v), dot(beside, beside), exponent);
#ifndef HIGHLIGHT_WITHOUT_COSINE
    highlight *= n_dot_l;
#endif
    return diffuse_color(base_color, metallic) * (1.0 / PI) * n_dot_l
        + reflectance_f0(base_color, metallic, specular) * highlight;
}

vec3 direct(Surface surface) {
    vec3 to_light;
    float received = received_at(surface.position, to_light);
    return light_power * received * phong(surface.base_color, surface.metallic, surface.roughness, surface.specular,
                                          surface.normal, surface.view, to_light);
}
