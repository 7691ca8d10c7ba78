// What a material returns of light that is the same all over its two lobes. Twin: constant_ambient's.
#include "brdf.glsl"
#include "environment_brdf.glsl"

// Of the specular lobe.
vec3 specular_albedo(vec3 base_color, float metallic, float roughness, float specular, float n_dot_v) {
    vec2 brdf = environment_brdf(roughness, n_dot_v);
    return reflectance_f0(base_color, metallic, specular) * brdf.x + reflectance_f90(metallic, specular) * brdf.y;
}

// Of the base: what a dielectric mirrors it does not get.
vec3 diffuse_albedo(vec3 base_color, float metallic, float roughness, float specular, float n_dot_v) {
    vec2 brdf = environment_brdf(roughness, n_dot_v);
    float above = specular * (0.04 * brdf.x + brdf.y);
    return (1.0 - above) * diffuse_color(base_color, metallic);
}
