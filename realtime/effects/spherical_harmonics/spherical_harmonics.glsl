// Light from the environment, as smooth as its first harmonics.
#include "ambient_albedo.glsl"
#include "sh_irradiance.glsl"

vec3 environment(Surface surface) {
    float n_dot_v = dot(surface.normal, surface.view);
    vec3 diffuse = diffuse_albedo(surface.base_color, surface.metallic, surface.roughness, surface.specular, n_dot_v);
    vec3 mirrored = specular_albedo(surface.base_color, surface.metallic, surface.roughness, surface.specular, n_dot_v);
    return diffuse * sh_radiance(surface.normal) + mirrored * sh_radiance(reflect(-surface.view, surface.normal));
}
