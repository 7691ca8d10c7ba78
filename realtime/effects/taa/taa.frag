// Karis 2014: a new frame is blended into the history of those before it.
uniform sampler2D current;
uniform sampler2D history;
uniform float share;  // of the new frame
#ifdef WEIGH
uniform float exposure_scale;
#endif
out vec4 result;

// Malvar & Sullivan 2003, without the halves' shifts: luma, orange against blue, green against the others.
vec3 to_ycocg(vec3 c) {
    return vec3(0.25 * (c.r + c.b) + 0.5 * c.g, 0.5 * (c.r - c.b), 0.5 * c.g - 0.25 * (c.r + c.b));
}

vec3 from_ycocg(vec3 c) {
    float rest = c.x - c.z;
    return vec3(rest + c.y, c.x + c.z, rest - c.y);
}

vec3 clamped(vec3 old, ivec2 pixel) {
    ivec2 last = textureSize(current, 0) - 1;
    vec3 low = vec3(3e38), high = vec3(-3e38);
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            vec3 near = to_ycocg(texelFetch(current, clamp(pixel + ivec2(x, y), ivec2(0), last), 0).rgb);
            low = min(low, near);
            high = max(high, near);
        }
    }
    return from_ycocg(clamp(to_ycocg(old), low, high));
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 fresh = texelFetch(current, pixel, 0).rgb;
    if (share == 1.0) {
        result = vec4(fresh, 1.0);
        return;
    }
    vec3 old = texelFetch(history, pixel, 0).rgb;
#ifdef CLAMP
    old = clamped(old, pixel);
#endif
    vec2 weights = vec2(1.0 - share, share);
#ifdef WEIGH
    weights /= 1.0 + exposure_scale * max(vec2(to_ycocg(old).x, to_ycocg(fresh).x), 0.0);
    weights /= weights.x + weights.y;
#endif
    result = vec4(weights.x * old + weights.y * fresh, 1.0);
}
