// Light from the environment, as smooth as the cosine makes it.
#include "ambient_albedo.glsl"
#include "cube_atlas.glsl"
uniform sampler2D irradiance_atlas;

vec3 environment(Surface surface) {
    float n_dot_v = dot(surface.normal, surface.view);
    vec3 diffuse = diffuse_albedo(surface.base_color, surface.metallic, surface.roughness, surface.specular, n_dot_v);
    vec3 mirrored = specular_albedo(surface.base_color, surface.metallic, surface.roughness, surface.specular, n_dot_v);
    vec3 axis = reflect(-surface.view, surface.normal);
    return diffuse * atlas_level(irradiance_atlas, surface.normal, 0, IRRADIANCE_SIDE) +
           mirrored * atlas_level(irradiance_atlas, axis, 0, IRRADIANCE_SIDE);
}
