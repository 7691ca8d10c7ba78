// Light of one radiance from everywhere: the Lambert base and Fresnel at normal incidence reflect it.
#include "brdf.glsl"
uniform vec3 environment_radiance;
uniform vec3 indirect_radiance;

vec3 ambient_albedo(vec3 base_color, float metallic, float specular) {
    vec3 f0 = reflectance_f0(base_color, metallic, specular);
    return f0 + (1.0 - f0) * diffuse_color(base_color, metallic);
}

vec3 environment(Surface surface) {
    return environment_radiance * ambient_albedo(surface.base_color, surface.metallic, surface.specular);
}

vec3 indirect(Surface surface) {
    return indirect_radiance * ambient_albedo(surface.base_color, surface.metallic, surface.specular);
}
