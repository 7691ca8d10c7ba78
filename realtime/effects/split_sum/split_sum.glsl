// The environment filtered with the lobe, times the lobe's albedo (Karis 2013, "Real Shading in Unreal Engine 4").
#include "brdf.glsl"
#include "cube_atlas.glsl"
#include "sh_irradiance.glsl"
#ifdef LAYER_COAT
#include "clear_coat.glsl"
#endif
#ifdef LAYER_GRAIN
#include "anisotropy.glsl"
#endif
#ifdef LAYER_SHEEN
#include "sheen.glsl"
#endif
uniform sampler2D radiance_atlas;
uniform sampler2D irradiance_atlas;
uniform sampler2D albedo_table; // x: n·v, y: roughness; scale and bias of F0, mean of Schlick's weight over the base

// Where a lobe is looked up: the mirror direction, at the normal of its layer or one bent along its grain.
vec3 lobe_axis(vec3 n, vec3 v) {
    return 2.0 * dot(n, v) * n - v;
}

vec3 under_lobe(vec3 n, vec3 v, float roughness) {
    return atlas_towards(radiance_atlas, lobe_axis(n, v), roughness * float(LEVELS - 1), SPECULAR_SIDE);
}

vec3 albedos(float n_dot_v, float roughness) {
    vec2 size = vec2(textureSize(albedo_table, 0));
    return textureLod(albedo_table, (vec2(n_dot_v, roughness) * (size - 1.0) + 0.5) / size, 0.0).rgb;
}

vec3 irradiance(vec3 normal) {
#ifdef IRRADIANCE_SIDE
    return atlas_level(irradiance_atlas, normal, 0, IRRADIANCE_SIDE);
#else
    return sh_radiance(normal);
#endif
}

// glTF's material: a dielectric mirrors away what its base does not get; what is lost between microfacets stays lost.
//   mirrored, around: radiance under the lobe, and irradiance over π
vec3 single_scattering(vec3 f0, vec3 f90, vec3 base, float specular, vec3 table, vec3 mirrored, vec3 around) {
    float above = specular * (0.04 * (1.0 - table.z) + table.z);
    return mirrored * (f0 * table.x + f90 * table.y) + around * base * (1.0 - above);
}

// Fdez-Agüera 2019, "A Multiple-Scattering Microfacet Model for Real-Time Image-based Lighting", listing 3: what is lost is
// scattered again as irradiance, and the base gets what is left. Schlick's mean is F0 + (F90 − F0)/21.
vec3 multiple_scattering(vec3 f0, vec3 f90, vec3 base, float specular, vec3 table, vec3 mirrored, vec3 around) {
    vec3 once = f0 * table.x + f90 * table.y;
    float lost = 1.0 - (table.x + table.y);
    vec3 mean = f0 + (f90 - f0) * (1.0 / 21.0);
    vec3 again = lost * once * mean / (1.0 - mean * lost);
    return mirrored * once + around * (again + base * (1.0 - once - again));
}

vec3 environment(Surface surface) {
    float n_dot_v = dot(surface.normal, surface.view);
    vec3 facet = surface.normal;
    float roughness = surface.roughness;
#if defined(LAYER_GRAIN) && defined(BENT)
    facet = bent_normal(roughness, surface.anisotropy, surface.anisotropy_direction, facet, surface.view);
#elif defined(LAYER_GRAIN)
    roughness = round_roughness(roughness, surface.anisotropy);
#endif
    vec3 value = COMPENSATION(reflectance_f0(surface.base_color, surface.metallic, surface.specular),
                              reflectance_f90(surface.metallic, surface.specular),
                              diffuse_color(surface.base_color, surface.metallic), surface.specular,
                              albedos(n_dot_v, roughness), under_lobe(facet, surface.view, roughness),
                              irradiance(surface.normal));
#ifdef LAYER_SHEEN
    // Its lobe is widest at grazing angles, nearer to the base's than to GGX's about the mirror direction.
    float returned = sheen_albedo(n_dot_v, surface.sheen_roughness);
    value = value * sheen_scaling(surface.sheen_color, returned, returned) +
            surface.sheen_color * returned * irradiance(surface.normal);
#endif
#ifdef LAYER_COAT
    // Its Fresnel term alone scales what it sees (Guy & Agopian 2018, Physically Based Rendering in Filament, on image
    // based lights); seen from below its own horizon it has no lobe, as in the definition.
    float coat_cosine = dot(surface.clearcoat_normal, surface.view);
    vec3 mirrored = under_lobe(surface.clearcoat_normal, surface.view, surface.clearcoat_roughness);
    value = mix(value, coat_cosine > 0.0 ? mirrored : vec3(0.0), coat_reflectance(surface.clearcoat, coat_cosine));
#endif
    return value;
}
