// A coat of index 1.5 over a material: KHR_materials_clearcoat. Twin: scenes/optics/clear_coat.py.
#include "brdf.glsl"

// The share of the coat in what is seen: of the view alone, alike for all light.
float coat_reflectance(float clearcoat, float n_dot_v) {
    return clearcoat * f_schlick(abs(n_dot_v), vec3(0.04), vec3(1.0)).x;
}

// D·V·(n·l), 1/sr, n the coat's own normal: the coat as if it reflected everything.
float coat_lobe(float roughness, vec3 n, vec3 v, vec3 l) {
    float n_dot_v = dot(n, v);
    float n_dot_l = dot(n, l);
    if (n_dot_v <= 0.0 || n_dot_l <= 0.0) return 0.0;
    vec3 cosines = half_cosines(n, v, l);
    float alpha = max(roughness * roughness, MIN_ALPHA);
    float d = d_ggx(cosines.x, cosines.y, alpha);
    return d * v_smith_ggx_correlated(max(n_dot_v, 1e-7), max(n_dot_l, 1e-7), alpha) * n_dot_l;
}

// f·(n·l) of a coated base, 1/sr.
vec3 coated(vec3 base, float clearcoat, float roughness, vec3 n, vec3 v, vec3 l) {
    return mix(base, vec3(coat_lobe(roughness, n, v, l)), coat_reflectance(clearcoat, dot(n, v)));
}
