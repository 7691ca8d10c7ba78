// Interleaved sampling: each pixel of a tile takes its own part of the virtual lights.
#include "surface.glsl"
#include "received.glsl"
#include "interleaved.glsl"
out vec4 light;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    Surface surface;
    bool seen = load_surface(pixel, surface);
    ivec2 cell = pixel % TILE;
    vec3 sum = reflected(surface, cell.y * TILE + cell.x, TILE * TILE, LIGHTS) * float(TILE * TILE);
    light = vec4(seen ? sum / tint(surface.base_color) : vec3(0.0), 0.0);
}
