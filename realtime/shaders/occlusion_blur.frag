// The mean over 4 × 4 texels of an occlusion whose pattern repeats every 4; with SAME_SURFACE over those of one surface.
#include "surface.glsl"
#include "surface_likeness.glsl"
uniform sampler2D occlusion_buffer;
uniform float thickness;
out vec4 mean;

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy), last = textureSize(occlusion_buffer, 0) - 1;
    Surface here;
    load_surface(SCALE * texel, here);
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int y = -2; y < 2; ++y) {
        for (int x = -2; x < 2; ++x) {
            ivec2 other = clamp(texel + ivec2(x, y), ivec2(0), last);
            float weight = 1.0;
#ifdef SAME_SURFACE
            Surface there;
            bool seen = load_surface(SCALE * other, there);
            weight = seen ? surface_likeness(there.position - here.position, here.normal, there.normal, thickness) : 0.0;
#endif
            sum += weight * texelFetch(occlusion_buffer, other, 0);
            weights += weight;
        }
    }
    mean = weights > 0.0 ? sum / weights : texelFetch(occlusion_buffer, texel, 0);
}
