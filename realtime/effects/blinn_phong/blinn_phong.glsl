// Radiance reflected from one punctual light, without its shadow.
#include "brdf.glsl"
#include "punctual.glsl"
#include "cosine_power.glsl"

// Giesen 2009: the albedo at normal incidence is 1.
float giesen(float exponent) {
    return (exponent + 2.0) * (exponent + 4.0) / (8.0 * PI * (exp2(-0.5 * exponent) + exponent));
}

// Akenine-Möller, Haines & Hoffman 2008, section 7.6.
float hoffman(float exponent) {
    return (exponent + 8.0) / (8.0 * PI);
}

float unscaled(float exponent) {
    return 1.0 / PI;
}

// f·(n·l), 1/sr.
vec3 blinn_phong(vec3 base_color, float metallic, float roughness, float specular, vec3 n, vec3 v, vec3 l) {
    float n_dot_l = dot(n, l);
    if (dot(n, v) <= 0.0 || n_dot_l <= 0.0) return vec3(0.0);
    float exponent = blinn_exponent(max(roughness * roughness, MIN_ALPHA));
    vec3 half_vector = half_cosines(n, v, l);
    float highlight = SCALE(exponent) * cosine_power(half_vector.x, half_vector.y, exponent);
#ifndef HIGHLIGHT_WITHOUT_COSINE
    highlight *= n_dot_l;
#endif
    return diffuse_color(base_color, metallic) * (1.0 / PI) * n_dot_l
        + reflectance_f0(base_color, metallic, specular) * highlight;
}

vec3 direct(Surface surface) {
    vec3 to_light;
    float received = received_at(surface.position, to_light);
    return light_power * received * blinn_phong(surface.base_color, surface.metallic, surface.roughness, surface.specular,
                                                surface.normal, surface.view, to_light);
}
