// Which share of a light reaches a point at most, of all distributions of depths with the four moments around it
// (Peters & Klein 2015, Hamburger moment shadow mapping).
#include "shadow_lookup.glsl"
uniform float moment_bias;
uniform float bleeding;

// Moments of a distribution that is a little blurred, so that rounding leaves them possible ones (Peters et al. 2017,
// Improved Moment Shadow Maps: towards the moments of depths spread over −1…1).
vec4 blurred(vec4 moments, float amount) {
    return mix(moments, vec4(0.0, 0.375, 0.0, 0.375), amount);
}

// What four moments say beyond the mean: B = L·D·Lᵀ is the Hankel matrix of (1, b), and these are in D and L.
struct Spread {
    float variance; // D₂
    float slope;    // L₃₂: how the square is expected to follow the depth
    float rest;     // D₃
};

Spread spread_of(vec4 b) {
    float variance = b.y - b.x * b.x;
    float skew = b.z - b.x * b.y;
    float slope = skew / variance;
    return Spread(variance, slope, b.w - b.y * b.y - slope * skew);
}

// The most that may lie at a depth: 1/(xᵀ·B⁻¹·x) with x = (1, z, z²), Christoffel's function.
float most_at(vec4 b, float z) {
    Spread s = spread_of(b);
    float away = z - b.x, beside = z * z - b.y - s.slope * away;
    return 1.0 / (1.0 + away * away / s.variance + beside * beside / s.rest);
}

// The least that lies before a depth z. Of the distributions with these moments the extremal one consists of z and two
// depths more, the roots of the quadratic with the coefficients B⁻¹·(1, z, z²), each with the most that may lie there
// (Peters & Klein 2015, section 3.2).
float least_before(vec4 b, float z) {
    Spread s = spread_of(b);
    float away = z - b.x;
    float quadratic = (z * z - b.y - s.slope * away) / s.rest;
    float linear = away / s.variance - s.slope * quadratic;
    float constant = 1.0 - b.x * linear - b.y * quadratic;
    float root = sqrt(max(linear * linear - 4.0 * quadratic * constant, 0.0));
    float larger = -0.5 * (linear + (linear < 0.0 ? -root : root)); // neither root by a difference
    // Where z lies between the others' weights one root is infinite.
    vec2 others = clamp(vec2(larger / quadratic, constant / larger), -1e9, 1e9);
    float first = min(others.x, others.y), second = max(others.x, others.y);
    return z <= first ? 0.0 : z <= second ? most_at(b, first) : 1.0 - most_at(b, z);
}

vec3 visibility(Surface surface) {
    vec4 moments;
    float depth, otherwise;
    if (!look_up(surface, moments, depth, otherwise)) return vec3(otherwise);
    float dark = least_before(blurred(moments, moment_bias), 2.0 * depth - 1.0);
    return vec3(darkened(1.0 - dark, bleeding));
}
