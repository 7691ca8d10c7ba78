// The first two moments of the depth within a texel, over which it is taken for a plane (Lauritzen 2007, Summed-Area
// Variance Shadow Maps, GPU Gems 3, section 8.4.2).
vec4 kept(float depth, vec2 slope) {
    return vec4(depth, depth * depth + 0.25 * dot(slope, slope), 0.0, 0.0);
}
