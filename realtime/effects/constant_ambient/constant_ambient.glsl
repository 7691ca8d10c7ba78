// Light of one radiance from everywhere, reflected by the Lambert base and by GGX's directional albedo.
#include "ambient_albedo.glsl"
#ifdef LAYER_COAT
#include "clear_coat.glsl"
#endif
#ifdef LAYER_SHEEN
#include "sheen.glsl"
#endif
uniform vec3 environment_radiance;
uniform vec3 indirect_radiance;

// The share of light from everywhere that is reflected.
vec3 ambient_albedo(vec3 base_color, float metallic, float roughness, float specular, float n_dot_v) {
    return specular_albedo(base_color, metallic, roughness, specular, n_dot_v) +
           diffuse_albedo(base_color, metallic, roughness, specular, n_dot_v);
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
