// Radiance reflected from one punctual light, without its shadow. The knobs name the functions that stand for the parts.
#include "brdf.glsl"
#include "punctual.glsl"
#include "microfacets.glsl"
#include "fresnel.glsl"
#include "compensation.glsl"
#ifdef LAYER_COAT
#include "clear_coat.glsl"
#endif

// f(v, l)·(n·l), 1/sr; as gltf_brdf in brdf.glsl.
vec3 reflected(vec3 base_color, float metallic, float roughness, float specular, vec3 n, vec3 v, vec3 l) {
    float n_dot_v = dot(n, v);
    float n_dot_l = dot(n, l);
    if (n_dot_v <= 0.0 || n_dot_l <= 0.0) return vec3(0.0);
    vec3 half_vector = half_cosines(n, v, l);
    float alpha = max(roughness * roughness, MIN_ALPHA);
    float d = DISTRIBUTION(half_vector.x, half_vector.y, alpha);
    float visible = MASKING(max(n_dot_v, 1e-7), max(n_dot_l, 1e-7), alpha);
    vec3 fresnel = FRESNEL(half_vector.z, base_color, metallic, specular);
    vec3 lobe = COMPENSATION(fresnel * (d * visible), reflectance_f0(base_color, metallic, specular),
                             reflectance_f90(metallic, specular), roughness, n_dot_v, n_dot_l);
    vec3 above = FRESNEL(half_vector.z, base_color, 0.0, specular);
    return ((1.0 - above) * diffuse_color(base_color, metallic) * (1.0 / PI) + lobe) * n_dot_l;
}

vec3 direct(Surface surface) {
    vec3 to_light;
    float received = received_at(surface.position, to_light);
    vec3 value = reflected(surface.base_color, surface.metallic, surface.roughness, surface.specular, surface.normal,
                           surface.view, to_light);
#ifdef LAYER_COAT
    value = coated(value, surface.clearcoat, surface.clearcoat_roughness, surface.clearcoat_normal, surface.view,
                   to_light);
#endif
    return light_power * received * value;
}
