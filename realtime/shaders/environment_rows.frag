// Row by row, what arrives from the whole sphere, weighted with functions of the direction: a column each.
#include "environment_map.glsl"
BASIS
out vec4 sum;

void main() {
    ivec2 cell = ivec2(gl_FragCoord.xy);
    float top = float(cell.y) * (3.14159265358979 / float(ROWS)), bottom = top + 3.14159265358979 / float(ROWS);
    float polar = 0.5 * (top + bottom), solid_angle = (cos(top) - cos(bottom)) * (6.28318530717959 / float(COLUMNS));
    vec3 total = vec3(0.0);
    for (int i = 0; i < COLUMNS; ++i) {
        // Through the texels' centres, however the map is turned.
        float azimuth = (float(i) + 0.5) * (6.28318530717959 / float(COLUMNS)) - environment_rotation;
        vec3 direction = vec3(sin(polar) * cos(azimuth), cos(polar), sin(polar) * sin(azimuth));
        total += environment_towards(direction) * basis(cell.x, direction);
    }
    sum = vec4(total * solid_angle, 0.0);
}
