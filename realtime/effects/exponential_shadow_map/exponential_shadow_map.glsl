// Which share of a light reaches a point: a step in the depths' difference, as an exponential that can be filtered ahead
// (Annen et al. 2008).
#include "shadow_lookup.glsl"

// e^(−c·(t − d)) for the depths d in the filter, at most 1; `mean` is that of e^(c·(d − 1)).
float faded(float mean, float depth) {
    return min(mean * exp(EXPONENT * (1.0 - depth)), 1.0);
}

vec3 visibility(Surface surface) {
    vec4 mean;
    float depth, otherwise;
    if (!look_up(surface, mean, depth, otherwise)) return vec3(otherwise);
    return vec3(faded(mean.x, depth));
}
