// Looks a point up in a map that was filtered before, with the hardware's own filter on top.
#include "shadow_views.glsl"
#include "shadow_depth.glsl"
uniform sampler2D shadow_map; // the views beside each other, COLUMNS in a row
uniform vec2 shadow_range;

// False where there is nothing to look up, with the visibility that holds there. The bias is for the texel alone: how the
// depth changes over the filter is in what is filtered.
bool look_up(Surface surface, out vec4 kept, out float depth, out float otherwise) {
    Receiver receiver;
    int view = view_of(surface.position);
    bool faces = receive(surface.position, surface.normal, view, 0.70710678, float(MEAN_RADIUS) + 1.0, receiver);
    vec2 tiles = vec2(textureSize(shadow_map, 0)) / float(RESOLUTION);
    vec2 place = (receiver.coordinate.xy + vec2(view % COLUMNS, view / COLUMNS)) / tiles;
    kept = textureLod(shadow_map, place, 0.0);
    depth = linear_depth(receiver.position, shadow_light, shadow_range);
    otherwise = faces ? 1.0 : 0.0;
    return faces && receiver.inside;
}

// Takes what is no more than `least` for dark, and spreads the rest (Lauritzen 2007, Summed-Area
// Variance Shadow Maps, GPU Gems 3, section 8.4.3).
float darkened(float share, float least) {
    return max((share - least) / (1.0 - least), 0.0);
}
