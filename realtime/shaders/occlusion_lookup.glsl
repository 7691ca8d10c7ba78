// The occlusion that a screen-space pass left, at a pixel; where it holds every other pixel, between those of the same
// surface (Kopf et al. 2007, "Joint Bilateral Upsampling").
#include "surface_likeness.glsl"
uniform sampler2D occlusion_buffer;
uniform float thickness;

vec4 occlusion_at(Surface surface, ivec2 pixel) {
#if SCALE == 1
    return texelFetch(occlusion_buffer, pixel, 0);
#else
    ivec2 low = pixel / SCALE, high = min((pixel + SCALE - 1) / SCALE, textureSize(occlusion_buffer, 0) - 1);
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 texel = ivec2((i & 1) == 0 ? low.x : high.x, (i & 2) == 0 ? low.y : high.y);
        Surface there;
        bool seen = load_surface(SCALE * texel, there);
        float weight =
            seen ? surface_likeness(there.position - surface.position, surface.normal, there.normal, thickness) : 0.0;
        weight = max(weight, 1e-4); // where no neighbour is of this surface, all of them
        sum += weight * texelFetch(occlusion_buffer, texel, 0);
        weights += weight;
    }
    return sum / weights;
#endif
}
