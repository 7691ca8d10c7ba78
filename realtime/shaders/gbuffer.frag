// The G-buffer: what the surface seen by a pixel is made of (deferred shading, Saito & Takahashi 1990).
#include "textures.glsl"
#include "normal_map.glsl"
#ifdef STORED_FORMATS
#include "stored.glsl"
#endif
uniform vec4 viewer;            // xyz: position, w = 1; or direction, w = 0
uniform vec4 base_color_factor; // a: alpha
uniform float metallic_factor;
uniform float roughness_factor;
uniform float specular_factor;
uniform vec3 emissive_factor;
uniform float normal_scale;
uniform float occlusion_strength;
uniform float alpha_cutoff;
#ifdef LAYER_COAT
uniform float clearcoat_factor;
uniform float clearcoat_roughness_factor;
uniform float clearcoat_normal_scale;
#endif
#ifdef LAYER_GRAIN
#include "anisotropy.glsl"
uniform float anisotropy_factor;
uniform vec2 grain_turn; // cosine and sine
#endif
#ifdef LAYER_SHEEN
uniform vec3 sheen_color_factor;
uniform float sheen_roughness_factor;
#endif
#ifdef LAYER_GLASS
uniform vec3 absorption;
uniform float ior;
#endif
uniform int shape;
in vec3 world_position;
in vec3 vertex_normal;
#ifdef HAS_TEXCOORD0
in vec2 uv0;
#endif
#ifdef HAS_TEXCOORD1
in vec2 uv1;
#endif
#ifdef HAS_TANGENT
in vec4 vertex_tangent;
#endif
#ifdef HAS_COLOR
in vec4 vertex_color;
#endif
TEXTURE_DECLARATIONS
ATTACHMENTS

void main() {
    vec4 base_color = base_color_factor;
#ifdef HAS_COLOR
    base_color *= vertex_color;
#endif
#ifdef TEXTURE_BASE_COLOR
    base_color *= look_up_base_color();
#endif
#ifdef ALPHA_MASK
    if (base_color.a < alpha_cutoff) discard;
#endif
    vec3 normal = vertex_normal;
#if defined(TEXTURE_NORMAL) && defined(HAS_TANGENT)
    normal = tangent_to_world(vertex_tangent.xyz, vertex_tangent.w, vertex_normal,
                              decode_normal(look_up_normal().rgb, normal_scale));
#else
    normal = normalize(normal);
#endif
    vec3 emission = emissive_factor;
#ifdef TEXTURE_EMISSIVE
    emission *= look_up_emissive().rgb;
#endif
    float metallic = metallic_factor;
    float roughness = roughness_factor;
#ifdef TEXTURE_METALLIC_ROUGHNESS
    vec4 metallic_roughness = look_up_metallic_roughness();
    metallic *= metallic_roughness.b;
    roughness *= metallic_roughness.g;
#endif
    float occlusion = 1.0;
#ifdef TEXTURE_OCCLUSION
    occlusion = 1.0 + occlusion_strength * (look_up_occlusion().r - 1.0);
#endif
#ifdef LAYER_GRAIN
    float anisotropy = anisotropy_factor;
    vec2 grain = grain_turn;
#ifdef TEXTURE_ANISOTROPY
    vec3 grain_texel = look_up_anisotropy().rgb;
    anisotropy *= grain_texel.b;
    grain = turned(grain, 2.0 * grain_texel.rg - 1.0);
#endif
#ifdef HAS_TANGENT
    vec3 anisotropy_direction = along_grain(vertex_tangent.xyz, vertex_tangent.w, vertex_normal, normal, grain);
#else
    vec3 anisotropy_direction = across(normal);
#endif
#endif
#ifdef LAYER_SHEEN
    vec3 sheen_color = sheen_color_factor;
    float sheen_roughness = sheen_roughness_factor;
#ifdef TEXTURE_SHEEN_COLOR
    sheen_color *= look_up_sheen_color().rgb;
#endif
#ifdef TEXTURE_SHEEN_ROUGHNESS
    sheen_roughness *= look_up_sheen_roughness().a;
#endif
#endif
#ifdef LAYER_COAT
    float clearcoat = clearcoat_factor;
    float clearcoat_roughness = clearcoat_roughness_factor;
#ifdef TEXTURE_CLEARCOAT
    clearcoat *= look_up_clearcoat().r;
#endif
#ifdef TEXTURE_CLEARCOAT_ROUGHNESS
    clearcoat_roughness *= look_up_clearcoat_roughness().g;
#endif
#if defined(TEXTURE_CLEARCOAT_NORMAL) && defined(HAS_TANGENT)
    vec3 clearcoat_normal = tangent_to_world(vertex_tangent.xyz, vertex_tangent.w, vertex_normal,
                                             decode_normal(look_up_clearcoat_normal().rgb, clearcoat_normal_scale));
#else
    vec3 clearcoat_normal = normalize(vertex_normal);
#endif
    clearcoat_normal = gl_FrontFacing ? clearcoat_normal : -clearcoat_normal;
#endif
#ifdef DOUBLE_SIDED
    normal = gl_FrontFacing ? normal : -normal;
#else
    // The back of a single-sided surface is opaque and black: no normal, no reflection, no emission.
    normal = gl_FrontFacing ? normal : vec3(0.0);
    emission = gl_FrontFacing ? emission : vec3(0.0);
#endif
    WRITES
}
