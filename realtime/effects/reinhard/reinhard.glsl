#include "luminance.glsl"
uniform float white;
uniform float prescale;

// Reinhard et al. 2002, eq. 4; of channels, or of a luminance.
vec3 reinhard(vec3 x, float brightest) {
    return x * (1.0 + x / (brightest * brightest)) / (1.0 + x);
}

vec3 tone(vec3 radiance) {
    vec3 x = clamp(radiance * prescale, 0.0, 1e9);
#ifdef ON_LUMINANCE
    float y = luminance(x);
    return clamp(x * (reinhard(vec3(y), white).x / max(y, 1e-20)), 0.0, 1.0);
#else
    return min(reinhard(x, white), 1.0);
#endif
}
