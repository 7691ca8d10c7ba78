// A screen-space occlusion pass: a technique's `vec4 occlusion(Surface, ivec2)` at every pixel, or every SCALE-th: the mean
// visible direction, and the share that is visible.
#include "surface.glsl"
EFFECT
out vec4 found;

void main() {
    ivec2 pixel = SCALE * ivec2(gl_FragCoord.xy);
    Surface surface;
    bool seen = load_surface(pixel, surface);
    found = seen ? occlusion(surface, pixel) : vec4(0.0, 0.0, 0.0, 1.0);
}
