#include "srgb_curve.glsl"

vec3 encode(vec3 linear) {
    return srgb_encode(linear);
}
