// What full-screen passes know of the surface behind a pixel; members are there where the G-buffer holds them.
uniform sampler2D gbuffer_position;
#ifdef GBUFFER_NORMAL_ROUGHNESS
uniform sampler2D gbuffer_normal_roughness;
#endif
#ifdef GBUFFER_BASE_COLOR_METALLIC
uniform sampler2D gbuffer_base_color_metallic;
#endif
#ifdef GBUFFER_SPECULAR_OCCLUSION
uniform sampler2D gbuffer_specular_occlusion;
#endif
#ifdef GBUFFER_CLEARCOAT_FACTORS
uniform sampler2D gbuffer_clearcoat_factors;
#endif
#ifdef GBUFFER_CLEARCOAT_NORMAL
uniform sampler2D gbuffer_clearcoat_normal;
#endif
#ifdef GBUFFER_GRAIN
uniform sampler2D gbuffer_grain;
#endif
#ifdef GBUFFER_SHEEN
uniform sampler2D gbuffer_sheen;
#endif
uniform vec4 viewer; // xyz: position, w = 1; or the direction to the viewer, w = 0

struct Surface {
    vec3 position;
    vec3 normal;
    vec3 view;
    vec3 base_color;
    float metallic;
    float roughness;
    float specular;
    float occlusion;
#ifdef LAYER_SHEEN
    vec3 sheen_color;
    float sheen_roughness;
#endif
#ifdef LAYER_GRAIN
    float anisotropy;
    vec3 anisotropy_direction;
#endif
#ifdef LAYER_COAT
    float clearcoat;
    float clearcoat_roughness;
    vec3 clearcoat_normal;
#endif
};

// False where the pixel shows no surface, or one seen from the dark side of its normal (n·v ≤ 0): there nothing is
// reflected (the one rule for back-facing directions, scenes/optics/material.py).
bool load_surface(ivec2 pixel, out Surface surface) {
    vec4 position = texelFetch(gbuffer_position, pixel, 0);
    bool seen = position.w > 0.0;
    surface.position = position.xyz;
    surface.view = normalize(viewer.xyz - viewer.w * position.xyz);
#ifdef GBUFFER_NORMAL_ROUGHNESS
    vec4 normal_roughness = texelFetch(gbuffer_normal_roughness, pixel, 0);
    surface.normal = normal_roughness.xyz;
    surface.roughness = normal_roughness.w;
    seen = seen && dot(surface.normal, surface.view) > 0.0;
#endif
#ifdef GBUFFER_BASE_COLOR_METALLIC
    vec4 base_color_metallic = texelFetch(gbuffer_base_color_metallic, pixel, 0);
    surface.base_color = base_color_metallic.rgb;
    surface.metallic = base_color_metallic.a;
#endif
#ifdef GBUFFER_SPECULAR_OCCLUSION
    vec2 specular_occlusion = texelFetch(gbuffer_specular_occlusion, pixel, 0).rg;
    surface.specular = specular_occlusion.r;
    surface.occlusion = specular_occlusion.g;
#endif
#ifdef GBUFFER_CLEARCOAT_FACTORS
    vec2 clearcoat_factors = texelFetch(gbuffer_clearcoat_factors, pixel, 0).rg;
    surface.clearcoat = clearcoat_factors.r;
    surface.clearcoat_roughness = clearcoat_factors.g;
#endif
#ifdef GBUFFER_CLEARCOAT_NORMAL
    surface.clearcoat_normal = texelFetch(gbuffer_clearcoat_normal, pixel, 0).xyz;
#elif defined(LAYER_COAT)
    surface.clearcoat_normal = surface.normal;
#endif
#ifdef GBUFFER_GRAIN
    vec4 grain = texelFetch(gbuffer_grain, pixel, 0);
    surface.anisotropy = grain.w;
    surface.anisotropy_direction = grain.xyz;
#endif
#ifdef GBUFFER_SHEEN
    vec4 sheen = texelFetch(gbuffer_sheen, pixel, 0);
    surface.sheen_color = sheen.rgb;
    surface.sheen_roughness = sheen.a;
#endif
#ifdef CONSTANT_BASE_COLOR
    surface.base_color = CONSTANT_BASE_COLOR;
#endif
#ifdef CONSTANT_METALLIC
    surface.metallic = CONSTANT_METALLIC;
#endif
#ifdef CONSTANT_ROUGHNESS
    surface.roughness = CONSTANT_ROUGHNESS;
#endif
#ifdef CONSTANT_SPECULAR
    surface.specular = CONSTANT_SPECULAR;
#endif
#ifdef CONSTANT_OCCLUSION
    surface.occlusion = CONSTANT_OCCLUSION;
#endif
#if defined(LAYER_COAT) && defined(CONSTANT_CLEARCOAT)
    surface.clearcoat = CONSTANT_CLEARCOAT;
#endif
#if defined(LAYER_COAT) && defined(CONSTANT_CLEARCOAT_ROUGHNESS)
    surface.clearcoat_roughness = CONSTANT_CLEARCOAT_ROUGHNESS;
#endif
#if defined(LAYER_SHEEN) && defined(CONSTANT_SHEEN_COLOR)
    surface.sheen_color = CONSTANT_SHEEN_COLOR;
#endif
#if defined(LAYER_SHEEN) && defined(CONSTANT_SHEEN_ROUGHNESS)
    surface.sheen_roughness = CONSTANT_SHEEN_ROUGHNESS;
#endif
    return seen;
}
