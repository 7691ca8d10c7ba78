#include "luminance.glsl"

// What of a colour is brighter than a threshold; its hue stays.
vec3 bright_part(vec3 color, float threshold) {
    float bright = luminance(color);
    return color * (max(bright - threshold, 0.0) / max(bright, 1e-20));
}
