// What one G-buffer holds, into another that stores it otherwise.
#include "surface.glsl"
ATTACHMENTS

void main() {
    Surface surface;
    if (!fetch_surface(ivec2(gl_FragCoord.xy), surface)) discard;
    vec3 world_position = surface.position;
    vec3 normal = surface.normal;
    vec3 base_color = surface.base_color;
    float metallic = surface.metallic;
    float roughness = surface.roughness;
    float specular_factor = surface.specular;
    float occlusion = surface.occlusion;
    WRITES
}
