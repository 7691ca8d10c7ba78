// Which share of a light reaches a point, from mean and variance of the depths around it (Donnelly & Lauritzen 2006).
#include "shadow_lookup.glsl"
uniform float least_variance;
uniform float bleeding;

// Chebyshev's one-sided inequality: of depths of that mean and variance at most σ²/(σ² + (t − µ)²) lie beyond t > µ.
float share_beyond(vec2 moments, float depth, float least) {
    float variance = max(moments.y - moments.x * moments.x, least);
    float beyond = depth - moments.x;
    return beyond <= 0.0 ? 1.0 : variance / (variance + beyond * beyond);
}

vec3 visibility(Surface surface) {
    vec4 moments;
    float depth, otherwise;
    if (!look_up(surface, moments, depth, otherwise)) return vec3(otherwise);
    return vec3(darkened(share_beyond(moments.xy, depth, least_variance), bleeding));
}
