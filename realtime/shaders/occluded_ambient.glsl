// The visibility of the environment as the term has it, occluded over unoccluded radiance: what remains of the scattered and
// of the mirrored part, weighted with what both would bring of light of one radiance from everywhere.
#include "ambient_albedo.glsl"
#include "specular_occlusion.glsl"

// What remains of the sum of two parts; of nothing, as of the first part.
vec3 remaining(vec3 scattered, vec3 mirrored, vec3 of_scattered, float of_mirrored) {
    vec3 first = scattered + 1e-5;
    return (first * of_scattered + mirrored * of_mirrored) / (first + mirrored);
}

// From a visibility of the scattered part per channel, its mean and the mean visible direction.
vec3 occluded_ambient(Surface surface, vec3 scattered_visibility, float visibility, vec3 bent) {
    float n_dot_v = dot(surface.normal, surface.view);
    float alpha = max(surface.roughness * surface.roughness, MIN_ALPHA);
    float mirrored_visibility =
        SPECULAR_OCCLUSION(visibility, n_dot_v, alpha, dot(bent, reflect(-surface.view, surface.normal)));
    return remaining(
        diffuse_albedo(surface.base_color, surface.metallic, surface.roughness, surface.specular, n_dot_v),
        specular_albedo(surface.base_color, surface.metallic, surface.roughness, surface.specular, n_dot_v),
        scattered_visibility, mirrored_visibility);
}
