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
#ifdef LAYER_COAT
    float clearcoat = surface.clearcoat;
    float clearcoat_roughness = surface.clearcoat_roughness;
    vec3 clearcoat_normal = surface.clearcoat_normal;
#endif
#ifdef LAYER_GRAIN
    float anisotropy = surface.anisotropy;
    vec3 anisotropy_direction = surface.anisotropy_direction;
#endif
#ifdef LAYER_SHEEN
    vec3 sheen_color = surface.sheen_color;
    float sheen_roughness = surface.sheen_roughness;
#endif
    WRITES
}
