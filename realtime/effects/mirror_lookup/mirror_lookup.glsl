// The environment mirrored without regard to roughness.
#include "ambient_albedo.glsl"
#include "environment_map.glsl"
uniform vec3 mean_radiance;

vec3 environment(Surface surface) {
    float n_dot_v = dot(surface.normal, surface.view);
    vec3 diffuse = diffuse_albedo(surface.base_color, surface.metallic, surface.roughness, surface.specular, n_dot_v);
    vec3 mirrored = specular_albedo(surface.base_color, surface.metallic, surface.roughness, surface.specular, n_dot_v);
    return diffuse * mean_radiance + mirrored * environment_towards(reflect(-surface.view, surface.normal));
}
