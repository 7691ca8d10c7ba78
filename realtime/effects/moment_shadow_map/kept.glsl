// The first four moments of a depth, taken to −1…1, where their matrix is conditioned best.
vec4 kept(float depth, vec2 slope) {
    float z = 2.0 * depth - 1.0;
    return vec4(z, z * z, z * z * z, z * z * z * z);
}
