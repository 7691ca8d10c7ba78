// The material's two lobes by themselves, for lights that each meets in another way. Twin: shared_twins.py.
#include "brdf.glsl"

// F·D·V·(n·l), 1/sr.
vec3 specular_lobe(vec3 base_color, float metallic, float roughness, float specular, vec3 n, vec3 v, vec3 l) {
    float n_dot_v = dot(n, v);
    float n_dot_l = dot(n, l);
    if (n_dot_v <= 0.0 || n_dot_l <= 0.0) return vec3(0.0);
    vec3 cosines = half_cosines(n, v, l);
    float alpha = max(roughness * roughness, MIN_ALPHA);
    float d = d_ggx(cosines.x, cosines.y, alpha);
    float visible = v_smith_ggx_correlated(max(n_dot_v, 1e-7), max(n_dot_l, 1e-7), alpha);
    return f_schlick(cosines.z, reflectance_f0(base_color, metallic, specular), reflectance_f90(metallic, specular)) *
           (d * visible * n_dot_l);
}

// (1 − F)·c_diff/π, 1/sr, F the dielectric's: what a unit of irradiance that comes from around l turns into.
vec3 diffuse_lobe(vec3 base_color, float metallic, float specular, vec3 v, vec3 l) {
    vec3 sum = v + l;
    float v_dot_h = dot(v, sum) * inversesqrt(max(dot(sum, sum), 1.2e-38));
    vec3 above = f_schlick(v_dot_h, vec3(0.04 * specular), vec3(specular));
    return (1.0 - above) * diffuse_color(base_color, metallic) * (1.0 / PI);
}
