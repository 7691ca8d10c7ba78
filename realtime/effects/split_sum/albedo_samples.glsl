// What a direction drawn from a lobe adds to the albedos that the table holds.
#include "brdf.glsl"
#include "sample_lobes.glsl"

vec3 view_at(float n_dot_v) {
    return vec3(sqrt(1.0 - n_dot_v * n_dot_v), 0.0, n_dot_v);
}

float schlick_weight(float v_dot_h) {
    float m = clamp(1.0 - v_dot_h, 0.0, 1.0);
    float m2 = m * m;
    return m2 * m2 * m;
}

// Scale and bias of F0 (Karis 2013): f·(n·l) over the density of the half vector's mirror direction, without F.
vec2 specular_sample(vec2 u, float n_dot_v, float alpha) {
    vec3 v = view_at(n_dot_v);
    vec3 h = ggx_half_vector(u, alpha);
    float v_dot_h = dot(v, h);
    float n_dot_l = 2.0 * v_dot_h * h.z - v.z;
    if (n_dot_l <= 0.0 || v_dot_h <= 0.0) return vec2(0.0);
    float weight = 4.0 * v_smith_ggx_correlated(n_dot_v, n_dot_l, alpha) * n_dot_l * v_dot_h / h.z;
    float edge = schlick_weight(v_dot_h);
    return weight * vec2(1.0 - edge, edge);
}

// Schlick's weight over the base: what it does not get of light from everywhere.
float diffuse_sample(vec2 u, float n_dot_v) {
    vec3 v = view_at(n_dot_v);
    return schlick_weight(dot(v, normalize(v + cosine_direction(u))));
}
