// What single scattering loses between microfacets, given back. The table is albedo.py's.
#include "brdf.glsl"
uniform sampler2D albedo_table; // x: √(n·v), y: roughness; r: E(n·v), g: its mean over the hemisphere

vec2 single_scattering_albedo(float cosine, float roughness) {
    vec2 size = vec2(textureSize(albedo_table, 0));
    return texture(albedo_table, (vec2(sqrt(cosine), roughness) * (size - 1.0) + 0.5) / size).rg;
}

// Turquin 2019, "Practical Multiple Scattering Compensation for Microfacet Models", eq. 16: the lobe is scaled by this.
vec3 turquin_scale(vec3 f0, float albedo) {
    return 1.0 + f0 * (1.0 - albedo) / albedo;
}

// Kulla & Conty 2017, "Revisiting Physically Based Shading at Imageworks": f_ms, with the Fresnel factor of Hill 2018
// (F̄²Ē in place of F̄Ē). Schlick's mean is exact: F0 + (F90 − F0)/21.
vec3 kulla_conty_lobe(vec3 f0, vec3 f90, float albedo_v, float albedo_l, float albedo_mean) {
    vec3 f = f0 + (f90 - f0) * (1.0 / 21.0);
    float lost = max(1.0 - albedo_mean, 1e-6);
    float unscaled = (1.0 - albedo_v) * (1.0 - albedo_l) / (PI * lost);
    return f * f * albedo_mean / (1.0 - f * lost) * unscaled;
}

vec3 uncompensated(vec3 lobe, vec3 f0, vec3 f90, float roughness, float n_dot_v, float n_dot_l) {
    return lobe;
}

vec3 turquin(vec3 lobe, vec3 f0, vec3 f90, float roughness, float n_dot_v, float n_dot_l) {
    return lobe * turquin_scale(f0, single_scattering_albedo(n_dot_v, roughness).r);
}

vec3 kulla_conty(vec3 lobe, vec3 f0, vec3 f90, float roughness, float n_dot_v, float n_dot_l) {
    vec2 toward_v = single_scattering_albedo(n_dot_v, roughness);
    return lobe + kulla_conty_lobe(f0, f90, toward_v.r, single_scattering_albedo(n_dot_l, roughness).r, toward_v.g);
}
