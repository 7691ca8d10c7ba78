// A cube map with coarser ones below it as tiles of one texture, so that every level can be drawn into: a row of six
// faces a level, each with a border of one texel that holds what lies beyond its edge, so that the hardware's filter
// never leaves a tile. A level has half the texels of the one above along its side, a power of two.
#include "cube_face.glsl"

// Where on its face, −1…1, a direction leaves (OpenGL 4.1, table 3.24).
vec2 on_face(vec3 d, int face) {
    if (face < 2) return vec2(face == 0 ? -d.z : d.z, -d.y) / abs(d.x);
    if (face < 4) return vec2(d.x, face == 2 ? d.z : -d.z) / abs(d.y);
    return vec2(face == 4 ? d.x : -d.x, -d.y) / abs(d.z);
}

// The direction, of any length, through a place on a face, or a little beyond its edge.
vec3 through_face(vec2 place, int face) {
    if (face < 2) return face == 0 ? vec3(1.0, -place.y, -place.x) : vec3(-1.0, -place.y, place.x);
    if (face < 4) return face == 2 ? vec3(place.x, 1.0, place.y) : vec3(place.x, -1.0, -place.y);
    return face == 4 ? vec3(place.x, -place.y, 1.0) : vec3(-place.x, -place.y, -1.0);
}

// The first row of a level: those above are side + 2, side/2 + 2, … high.
int first_row(int level, int side) {
    return 2 * (side - (side >> level)) + 2 * level;
}

// Texel coordinates in the atlas of a place −1…1 on a face.
vec2 in_atlas(vec2 place, int face, int level, int side) {
    float texels = float(side >> level);
    return vec2(float(face) * (texels + 2.0), float(first_row(level, side))) + 1.0 + (place * 0.5 + 0.5) * texels;
}

vec3 atlas_level(sampler2D atlas, vec3 direction, int level, int side) {
    int face = cube_face(direction);
    vec2 texel = in_atlas(on_face(direction, face), face, level, side);
    return textureLod(atlas, texel / vec2(textureSize(atlas, 0)), 0.0).rgb;
}

// Linear between two levels.
vec3 atlas_towards(sampler2D atlas, vec3 direction, float level, int side) {
    int low = int(level);
    vec3 fine = atlas_level(atlas, direction, low, side);
    float part = level - float(low);
    return part > 0.0 ? mix(fine, atlas_level(atlas, direction, low + 1, side), part) : fine;
}
