// The G-buffer's channels in the formats that are chosen: what is written into an attachment, and what its texel says.
#include "packing.glsl"
#include "srgb_curve.glsl"

#ifdef DEPTH_BITS
uniform vec2 depth_range;       // near and far
uniform vec4 depth_row;         // distance along the view, from world space
uniform mat4 world_from_pixel;  // of (x·z, y·z, z, 1); of (x, y, z, 1) where rays are parallel

float depth_of(vec3 position) {
    return TO_DEPTH(dot(depth_row, vec4(position, 1.0)), depth_range);
}

vec3 at_depth(vec2 pixel, float depth) {
    float z = FROM_DEPTH(depth, depth_range);
#ifdef PARALLEL_RAYS
    return (world_from_pixel * vec4(pixel, z, 1.0)).xyz;
#else
    return (world_from_pixel * vec4(pixel * z, z, 1.0)).xyz;
#endif
}

// 0 says that nothing is seen.
#if DEPTH_BITS == 32
float pack_depth(vec3 position) {
    return max(depth_of(position), 1e-30);
}

float unpack_depth(vec4 texel) {
    return texel.r;
}

#elif DEPTH_BITS == 24
vec3 pack_depth(vec3 position) {
    return bytes_of(depth_code(depth_of(position), 16777215.0)) / 255.0;
}

float unpack_depth(vec4 texel) {
    return from_depth_code(from_bytes(round(texel.rgb * 255.0)), 16777215.0);
}

#else
float pack_depth(vec3 position) {
    return depth_code(depth_of(position), 65535.0) / 65535.0;
}

float unpack_depth(vec4 texel) {
    return from_depth_code(round(texel.r * 65535.0), 65535.0);
}
#endif
#endif

#ifdef NORMAL_BITS
const float NORMAL_HALF_RANGE = float((1 << (NORMAL_BITS - 1)) - 1);
const float NO_NORMAL = 2.0 * NORMAL_HALF_RANGE + 1.0; // of the back of a single-sided surface

vec2 normal_codes(vec3 normal) {
    return dot(normal, normal) > 0.0 ? signed_codes(octahedral(normal), NORMAL_HALF_RANGE) : vec2(NO_NORMAL);
}

vec3 from_normal_codes(vec2 codes) {
    return codes.x < NO_NORMAL ? from_octahedral(from_signed_codes(codes, NORMAL_HALF_RANGE)) : vec3(0.0);
}

#if NORMAL_BITS == 12
vec3 pack_normal(vec3 normal) {
    return bytes_of_pair(normal_codes(normal)) / 255.0;
}

vec3 unpack_normal(vec4 texel) {
    return from_normal_codes(pair_from_bytes(round(texel.rgb * 255.0)));
}

#else
vec2 pack_normal(vec3 normal) {
    return normal_codes(normal) / NO_NORMAL;
}

vec3 unpack_normal(vec4 texel) {
    return from_normal_codes(round(texel.rg * NO_NORMAL));
}
#endif
#endif
