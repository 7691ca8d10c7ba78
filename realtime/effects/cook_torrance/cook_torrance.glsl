// Radiance reflected from one punctual light, without its shadow. The knobs name the functions that stand for the parts.
#include "brdf.glsl"
#include "punctual.glsl"
#include "microfacets.glsl"
#include "fresnel.glsl"
#include "compensation.glsl"
#ifdef LAYER_COAT
#include "clear_coat.glsl"
#endif
#if defined(LAYER_GRAIN) && defined(TAKES_GRAIN)
#include "anisotropy.glsl"
#endif
#ifdef LAYER_SHEEN
#include "sheen.glsl"
#endif

// f(v, l)·(n·l), 1/sr, of a gloss D·V over the base; both cosines above 0.
vec3 weighed(float gloss, float v_dot_h, vec3 base_color, float metallic, float roughness, float specular,
             float n_dot_v, float n_dot_l) {
    vec3 fresnel = FRESNEL(v_dot_h, base_color, metallic, specular);
    vec3 lobe = COMPENSATION(fresnel * gloss, reflectance_f0(base_color, metallic, specular),
                             reflectance_f90(metallic, specular), roughness, n_dot_v, n_dot_l);
    vec3 above = FRESNEL(v_dot_h, base_color, 0.0, specular);
    return ((1.0 - above) * diffuse_color(base_color, metallic) * (1.0 / PI) + lobe) * n_dot_l;
}

// As gltf_brdf in brdf.glsl.
vec3 reflected(vec3 base_color, float metallic, float roughness, float specular, vec3 n, vec3 v, vec3 l) {
    float n_dot_v = dot(n, v);
    float n_dot_l = dot(n, l);
    if (n_dot_v <= 0.0 || n_dot_l <= 0.0) return vec3(0.0);
    vec3 half_vector = half_cosines(n, v, l);
    float alpha = max(roughness * roughness, MIN_ALPHA);
    float d = DISTRIBUTION(half_vector.x, half_vector.y, alpha);
    float visible = MASKING(max(n_dot_v, 1e-7), max(n_dot_l, 1e-7), alpha);
    return weighed(d * visible, half_vector.z, base_color, metallic, roughness, specular, n_dot_v, n_dot_l);
}

#if defined(LAYER_GRAIN) && defined(TAKES_GRAIN)
// The same with a gloss stretched along a grain.
vec3 brushed(vec3 base_color, float metallic, float roughness, float specular, float strength, vec3 grain, vec3 n, vec3 v,
             vec3 l) {
    float n_dot_v = dot(n, v);
    float n_dot_l = dot(n, l);
    if (n_dot_v <= 0.0 || n_dot_l <= 0.0) return vec3(0.0);
    float gloss = grain_lobe(roughness, strength, grain, n, v, l);
    float v_dot_h = half_cosines(n, v, l).z;
    return weighed(gloss, v_dot_h, base_color, metallic, roughness, specular, n_dot_v, n_dot_l);
}
#endif

vec3 direct(Surface surface) {
    vec3 to_light;
    float received = received_at(surface.position, to_light);
#if defined(LAYER_GRAIN) && defined(TAKES_GRAIN)
    vec3 value = brushed(surface.base_color, surface.metallic, surface.roughness, surface.specular, surface.anisotropy,
                         surface.anisotropy_direction, surface.normal, surface.view, to_light);
#else
    vec3 value = reflected(surface.base_color, surface.metallic, surface.roughness, surface.specular, surface.normal,
                           surface.view, to_light);
#endif
#ifdef LAYER_SHEEN
    value = with_sheen(value, surface.sheen_color, surface.sheen_roughness, surface.normal, surface.view, to_light);
#endif
#ifdef LAYER_COAT
    value = coated(value, surface.clearcoat, surface.clearcoat_roughness, surface.clearcoat_normal, surface.view,
                   to_light);
#endif
    return light_power * received * value;
}
