// What was baked into the vertices, for both parts of what a surface reflects.
#include "occluded_ambient.glsl"
uniform sampler2D baked_buffer;

vec3 environment_visibility(Surface surface) {
    // Where a pixel's centre lies off the triangle by rounding, shares are extrapolated.
    float visible = clamp(texelFetch(baked_buffer, ivec2(gl_FragCoord.xy), 0).r, 0.0, 1.0);
    return occluded_ambient(surface, vec3(visible), visible, surface.normal);
}
