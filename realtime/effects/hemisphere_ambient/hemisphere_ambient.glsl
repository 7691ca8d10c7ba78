// Light of two colours, from the sky and from the ground.
#include "ambient_albedo.glsl"
uniform sampler2D hemisphere_colors; // sky, ground

vec3 between(vec3 sky, vec3 ground, float up) {
    return mix(ground, sky, 0.5 + 0.5 * up);
}

vec3 environment(Surface surface) {
    vec3 sky = texelFetch(hemisphere_colors, ivec2(0, 0), 0).rgb, ground = texelFetch(hemisphere_colors, ivec2(1, 0), 0).rgb;
    float n_dot_v = dot(surface.normal, surface.view);
    vec3 diffuse = diffuse_albedo(surface.base_color, surface.metallic, surface.roughness, surface.specular, n_dot_v);
    vec3 mirrored = specular_albedo(surface.base_color, surface.metallic, surface.roughness, surface.specular, n_dot_v);
    return diffuse * between(sky, ground, surface.normal.y) +
           mirrored * between(sky, ground, reflect(-surface.view, surface.normal).y);
}
