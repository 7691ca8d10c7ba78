// Radiance that other surfaces scatter here, from virtual lights.
#if TILE == 1
#include "received.glsl"

vec3 indirect(Surface surface) {
    return reflected(surface, 0, 1, LIGHTS);
}
#else
#include "tile_mean.glsl"
uniform sampler2D interleaved; // what gather.frag found: for each pixel, from its own part of the lights

vec3 indirect(Surface surface) {
    return tile_mean(interleaved, surface) * tint(surface.base_color);
}
#endif
