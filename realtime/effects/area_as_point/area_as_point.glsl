// Radiance reflected from an emissive surface that is taken for a point.
#include "brdf.glsl"
#include "lights.glsl"
uniform vec3 light_position;
uniform vec3 light_normal;    // zero: not flat, no horizon
uniform vec3 light_intensity; // W/sr, along the normal
uniform bool two_sided;
uniform bool cosine_profile;

float emitted(float cos_light, bool flat_light, bool both_sides, bool cosine) {
    float c = both_sides ? abs(cos_light) : cos_light;
    if (!flat_light) return 1.0;
    if (c <= 0.0) return 0.0;
    return cosine ? c : 1.0;
}

vec3 direct(Surface surface) {
    vec3 to_light;
    float received = from_position(light_position, surface.position, to_light);
    bool flat_light = dot(light_normal, light_normal) > 0.0;
    received *= emitted(-dot(to_light, light_normal), flat_light, two_sided, cosine_profile);
    return light_intensity * received * gltf_brdf(surface.base_color, surface.metallic, surface.roughness,
                                                  surface.specular, surface.normal, surface.view, to_light);
}
