#include "ghost_weight.glsl"
uniform sampler2D bright;
uniform int ghosts;
uniform float dispersal;
uniform float halo;
uniform float chroma;
out vec4 result;

// Red and blue lie apart along a direction; beyond the picture all is black.
vec3 apart(vec2 place, vec2 direction) {
    vec3 light = vec3(0.0);
    for (int i = 0; i < 3; i++) {
        vec2 at = place + direction * chroma * float(i - 1);
        if (all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(1.0)))) light[i] = texture(bright, at)[i];
    }
    return light;
}

void main() {
    vec2 size = vec2(textureSize(bright, 0));
    vec2 mirrored = 1.0 - gl_FragCoord.xy / size;
    vec2 inward = 0.5 - mirrored;
    float away = length(inward);
    vec2 direction = away > 0.0 ? inward / away : vec2(0.0);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < ghosts; i++) {
        vec2 place = mirrored + inward * dispersal * float(i);
        sum += apart(place, direction) * ghost_weight(length(0.5 - place));
    }
    if (halo > 0.0) {
        vec2 place = mirrored + direction * halo * vec2(size.y / size.x, 1.0);
        sum += apart(place, direction) * ghost_weight(length(0.5 - place));
    }
    result = vec4(sum, 1.0);
}
