// Light of one radiance from everywhere, reflected by the Lambert base and by GGX's directional albedo.
#include "brdf.glsl"
#ifdef LAYER_COAT
#include "clear_coat.glsl"
#endif
#ifdef LAYER_SHEEN
#include "sheen.glsl"
#endif
uniform vec3 environment_radiance;
uniform vec3 indirect_radiance;

// Scale and bias of F0 in GGX's directional albedo: a fit for mobile hardware (Karis 2014, "Physically Based Shading on
// Mobile"; every constant is its).
vec2 environment_brdf(float roughness, float n_dot_v) {
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a004 = min(r.x * r.x, exp2(-9.28 * n_dot_v)) * r.x + r.y;
    return vec2(-1.04, 1.04) * a004 + r.zw;
}

// The share of light from everywhere that is reflected; what a dielectric mirrors its base does not get.
vec3 ambient_albedo(vec3 base_color, float metallic, float roughness, float specular, float n_dot_v) {
    vec2 brdf = environment_brdf(roughness, n_dot_v);
    vec3 mirrored = reflectance_f0(base_color, metallic, specular) * brdf.x + reflectance_f90(metallic, specular) * brdf.y;
    float above = specular * (0.04 * brdf.x + brdf.y);
    return mirrored + (1.0 - above) * diffuse_color(base_color, metallic);
}

vec3 surface_albedo(Surface surface) {
    vec3 value = ambient_albedo(surface.base_color, surface.metallic, surface.roughness, surface.specular,
                                dot(surface.normal, surface.view));
#ifdef LAYER_SHEEN
    float returned = sheen_albedo(dot(surface.normal, surface.view), surface.sheen_roughness);
    value = surface.sheen_color * returned + value * sheen_scaling(surface.sheen_color, returned, returned);
#endif
#ifdef LAYER_COAT
    // The coat mirrors what it takes, and what it mirrors is the same from everywhere: as a prefiltered map is scaled
    // by its Fresnel term alone (Guy & Agopian 2018, Physically Based Rendering in Filament, on image based lights).
    float mirrored = coat_reflectance(surface.clearcoat, dot(surface.clearcoat_normal, surface.view));
    value = mix(value, vec3(1.0), mirrored);
#endif
    return value;
}

vec3 environment(Surface surface) {
    return environment_radiance * surface_albedo(surface);
}

vec3 indirect(Surface surface) {
    return indirect_radiance * surface_albedo(surface);
}
