// Fills one level of a cube atlas with `vec3 baked(vec3 direction, int level)`.
#include "cube_atlas.glsl"
BAKED
uniform int level;
out vec4 texel;

void main() {
    int side = SIDE >> level;
    ivec2 cell = ivec2(gl_FragCoord.xy) - ivec2(0, first_row(level, SIDE));
    int face = cell.x / (side + 2);
    vec2 place = (vec2(cell.x - face * (side + 2), cell.y) - 0.5) * (2.0 / float(side)) - 1.0;
    texel = vec4(baked(normalize(through_face(place, face)), level), 1.0);
}
