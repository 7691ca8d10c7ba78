// What full-screen passes know of the surface behind a pixel; members are there where the G-buffer holds them.
#ifdef STORED_FORMATS
#include "stored.glsl"
#endif
// Of these a program has only those that it reads.
uniform sampler2D gbuffer_position, gbuffer_depth;
uniform sampler2D gbuffer_normal_roughness, gbuffer_normal, gbuffer_octahedral_normal, gbuffer_roughness;
uniform sampler2D gbuffer_base_color_metallic, gbuffer_base_color, gbuffer_metallic;
uniform sampler2D gbuffer_specular_occlusion, gbuffer_parameters;
uniform sampler2D gbuffer_clearcoat_factors, gbuffer_clearcoat_normal, gbuffer_grain, gbuffer_sheen;
uniform sampler2D gbuffer_glass;
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
#ifdef LAYER_GLASS
    vec3 absorption; // 1/m
    float ior; // 0 where it is opaque
#endif
#ifdef LAYER_COAT
    float clearcoat;
    float clearcoat_roughness;
    vec3 clearcoat_normal;
#endif
};

// How many pixels there are, across and upright.
ivec2 gbuffer_size() {
#ifdef GBUFFER_DEPTH
    return textureSize(gbuffer_depth, 0);
#else
    return textureSize(gbuffer_position, 0);
#endif
}

// Where that lies which a pixel shows; w = 0 where it shows no surface.
vec4 fetch_place(ivec2 pixel) {
#ifdef GBUFFER_DEPTH
    vec4 depth = texelFetch(gbuffer_depth, pixel, 0);
    bool seen = any(notEqual(depth.rgb, vec3(0.0)));
    return vec4(at_depth(vec2(pixel) + 0.5, unpack_depth(depth)), seen ? 1.0 : 0.0);
#else
    return texelFetch(gbuffer_position, pixel, 0);
#endif
}

// False where the pixel shows no surface.
bool fetch_surface(ivec2 pixel, out Surface surface) {
    vec4 place = fetch_place(pixel);
    bool seen = place.w > 0.0;
    surface.position = place.xyz;
    surface.view = normalize(viewer.xyz - viewer.w * surface.position);
#ifdef GBUFFER_NORMAL_ROUGHNESS
    vec4 normal_roughness = texelFetch(gbuffer_normal_roughness, pixel, 0);
    surface.normal = normal_roughness.xyz;
    surface.roughness = normal_roughness.w;
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
#ifdef GBUFFER_NORMAL
    surface.normal = texelFetch(gbuffer_normal, pixel, 0).xyz;
    surface.normal *= inversesqrt(max(dot(surface.normal, surface.normal), 1e-30));
#endif
#ifdef GBUFFER_OCTAHEDRAL_NORMAL
    surface.normal = unpack_normal(texelFetch(gbuffer_octahedral_normal, pixel, 0));
#endif
#ifdef GBUFFER_BASE_COLOR
    surface.base_color = texelFetch(gbuffer_base_color, pixel, 0).rgb;
#ifdef BASE_COLOR_IN_SRGB
    surface.base_color = srgb_decode(surface.base_color);
#endif
#endif
#ifdef GBUFFER_ROUGHNESS
    surface.roughness = texelFetch(gbuffer_roughness, pixel, 0).r;
#endif
#ifdef GBUFFER_METALLIC
    surface.metallic = texelFetch(gbuffer_metallic, pixel, 0).r;
#endif
#ifdef GBUFFER_PARAMETERS
    vec4 parameters = texelFetch(gbuffer_parameters, pixel, 0);
    surface.roughness = parameters.r;
    surface.metallic = parameters.g;
    surface.specular = parameters.b;
    surface.occlusion = parameters.a;
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
#ifdef GBUFFER_GLASS
    vec4 glass = texelFetch(gbuffer_glass, pixel, 0);
    surface.absorption = glass.rgb;
    surface.ior = glass.a;
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

// False also where the surface is seen from the dark side of its normal (n·v ≤ 0): there nothing is reflected (the one
// rule for back-facing directions, scenes/optics/material.py).
bool load_surface(ivec2 pixel, out Surface surface) {
    bool seen = fetch_surface(pixel, surface);
#ifdef GBUFFER_HAS_NORMAL
    seen = seen && dot(surface.normal, surface.view) > 0.0;
#endif
    return seen;
}
