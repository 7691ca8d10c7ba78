// What a surface reflects of light of one radiance from everywhere: mirrored by the microfacets, and scattered by the base.
#include "brdf.glsl"

// Scale and bias of F0 in GGX's directional albedo: a fit for mobile hardware (Karis 2014, "Physically Based Shading on
// Mobile"; every constant is its).
vec2 environment_brdf(float roughness, float n_dot_v) {
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a004 = min(r.x * r.x, exp2(-9.28 * n_dot_v)) * r.x + r.y;
    return vec2(-1.04, 1.04) * a004 + r.zw;
}

// The share that microfacets mirror, by `environment_brdf`.
vec3 mirrored_share(vec2 brdf, vec3 base_color, float metallic, float specular) {
    return reflectance_f0(base_color, metallic, specular) * brdf.x + reflectance_f90(metallic, specular) * brdf.y;
}

// The share that the base scatters: what a dielectric mirrors it does not get.
vec3 scattered_share(vec2 brdf, vec3 base_color, float metallic, float specular) {
    float above = specular * (0.04 * brdf.x + brdf.y);
    return (1.0 - above) * diffuse_color(base_color, metallic);
}
