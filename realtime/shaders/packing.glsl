// What the G-buffer holds, in fewer bytes. Twin: realtime/packing_twins.py. Codes are whole numbers; an attachment of
// 8- or 16-bit numbers from 0 to 1 holds them exactly.

// Distances along the view between `range.x` and `range.y` to 0…1, and back.
float linear_depth(float z, vec2 range) {
    return (z - range.x) / (range.y - range.x);
}

float from_linear_depth(float depth, vec2 range) {
    return range.x + depth * (range.y - range.x);
}

float linear_depth_reversed(float z, vec2 range) {
    return (range.y - z) / (range.y - range.x);
}

float from_linear_depth_reversed(float depth, vec2 range) {
    return range.y - depth * (range.y - range.x);
}

// What a perspective projection puts into a depth buffer, even steps of 1/z: here 1 at the near plane, so that a float's
// fine steps near 0 make up for the coarse ones of 1/z far away (Reed 2015, "Depth Precision Visualized").
float reversed_depth(float z, vec2 range) {
    return range.x * (range.y - z) / (z * (range.y - range.x));
}

float from_reversed_depth(float depth, vec2 range) {
    return range.x * range.y / (range.x + depth * (range.y - range.x));
}

// The same with 1 at the far plane. What is far is near 1, and all that is left of it are the last bits.
float standard_depth(float z, vec2 range) {
    return 1.0 - reversed_depth(z, range);
}

float from_standard_depth(float depth, vec2 range) {
    return from_reversed_depth(1.0 - depth, range);
}

// 0…1 to 1…largest: code 0 is left to say that nothing is seen.
float depth_code(float depth, float largest) {
    return 1.0 + round(clamp(depth, 0.0, 1.0) * (largest - 1.0));
}

float from_depth_code(float code, float largest) {
    return (code - 1.0) / (largest - 1.0);
}

// 24 bits as three of 8.
vec3 bytes_of(float code) {
    return vec3(floor(code / 65536.0), mod(floor(code / 256.0), 256.0), mod(code, 256.0));
}

float from_bytes(vec3 bytes) {
    return dot(bytes, vec3(65536.0, 256.0, 1.0));
}

vec2 sign_not_zero(vec2 v) {
    return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0);
}

// Meyer et al. 2010, "On Floating-Point Normal Vectors"; Cigolle et al. 2014, "A Survey of Efficient Representations for
// Independent Unit Vectors": the sphere's directions on an octahedron, which unfolds onto the square from −1 to 1.
vec2 octahedral(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    return n.z < 0.0 ? (1.0 - abs(p.yx)) * sign_not_zero(p) : p;
}

vec3 from_octahedral(vec2 e) {
    vec3 v = vec3(e, 1.0 - abs(e.x) - abs(e.y));
    v.xy = v.z < 0.0 ? (1.0 - abs(v.yx)) * sign_not_zero(v.xy) : v.xy;
    return v * inversesqrt(dot(v, v));
}

// −1…1 to 0…2·half, so that 0 has a code of its own, `half`; and one code more is left to say that there is no normal.
vec2 signed_codes(vec2 x, float half_range) {
    return round(clamp(x, -1.0, 1.0) * half_range) + half_range;
}

vec2 from_signed_codes(vec2 codes, float half_range) {
    return (codes - half_range) / half_range;
}

// Two codes of 12 bits as three of 8.
vec3 bytes_of_pair(vec2 codes) {
    return vec3(floor(codes.x / 16.0), mod(codes.x, 16.0) * 16.0 + floor(codes.y / 256.0), mod(codes.y, 256.0));
}

vec2 pair_from_bytes(vec3 bytes) {
    return vec2(bytes.x * 16.0 + floor(bytes.y / 16.0), mod(bytes.y, 16.0) * 256.0 + bytes.z);
}
