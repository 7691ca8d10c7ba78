// The six faces of cubes, three beside each other and two upon each other: what is seen from a cube's centre.
#include "cube_face.glsl"
uniform sampler2D cube_images[CUBES];
uniform mat4 cube_views[6 * CUBES]; // world to clip space
uniform vec3 cube_centres[CUBES];

// Where in a cube's picture a direction lies, 0…1.
vec2 place_in_cube(int cube, vec3 direction) {
    int face = cube_face(direction);
    vec4 clip = cube_views[6 * cube + face] * vec4(cube_centres[cube] + direction, 1.0);
    return (clip.xy / clip.w * 0.5 + 0.5 + vec2(face % 3, face / 3)) / vec2(3.0, 2.0);
}

vec3 from_cube(int cube, vec3 direction) {
    return textureLod(cube_images[cube], place_in_cube(cube, direction), 0.0).rgb;
}
