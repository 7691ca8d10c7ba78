// Light of one radiance from everywhere, reflected by the Lambert base and by GGX's directional albedo.
#include "ambient_albedo.glsl"
uniform vec3 environment_radiance;
uniform vec3 indirect_radiance;

// The share of light from everywhere that is reflected.
vec3 ambient_albedo(vec3 base_color, float metallic, float roughness, float specular, float n_dot_v) {
    return specular_albedo(base_color, metallic, roughness, specular, n_dot_v) +
           diffuse_albedo(base_color, metallic, roughness, specular, n_dot_v);
}

vec3 environment(Surface surface) {
    return environment_radiance * ambient_albedo(surface.base_color, surface.metallic, surface.roughness,
                                                 surface.specular, dot(surface.normal, surface.view));
}

vec3 indirect(Surface surface) {
    return indirect_radiance * ambient_albedo(surface.base_color, surface.metallic, surface.roughness,
                                              surface.specular, dot(surface.normal, surface.view));
}
