// The environment filtered with the lobe, times the lobe's albedo (Karis 2013, "Real Shading in Unreal Engine 4").
#include "brdf.glsl"
#include "cube_atlas.glsl"
#include "sh_irradiance.glsl"
uniform sampler2D radiance_atlas;
uniform sampler2D irradiance_atlas;
uniform sampler2D albedo_table; // x: n·v, y: roughness; scale and bias of F0, mean of Schlick's weight over the base

// Where the lobe is looked up: the mirror direction. A layer that bends or adds a lobe has an axis of its own.
vec3 lobe_axis(vec3 n, vec3 v) {
    return 2.0 * dot(n, v) * n - v;
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
    vec3 axis = lobe_axis(surface.normal, surface.view);
    vec3 mirrored = atlas_towards(radiance_atlas, axis, surface.roughness * float(LEVELS - 1), SPECULAR_SIDE);
    return COMPENSATION(reflectance_f0(surface.base_color, surface.metallic, surface.specular),
                        reflectance_f90(surface.metallic, surface.specular),
                        diffuse_color(surface.base_color, surface.metallic), surface.specular,
                        albedos(dot(surface.normal, surface.view), surface.roughness), mirrored,
                        irradiance(surface.normal));
}
