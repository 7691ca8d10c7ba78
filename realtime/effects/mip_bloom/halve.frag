// Jimenez 2014, 13 bilinear taps: four overlapping boxes of 2 × 2 with a weight of 1/8, one in the middle with 1/2.
uniform sampler2D image;
uniform vec2 half_size;  // pixels of the target
out vec4 result;

vec3 at(vec2 offset) {
    return texture(image, gl_FragCoord.xy / half_size + offset / vec2(textureSize(image, 0))).rgb;
}

void main() {
    vec3 inner = at(vec2(-1, -1)) + at(vec2(1, -1)) + at(vec2(-1, 1)) + at(vec2(1, 1));
    vec3 corners = at(vec2(-2, -2)) + at(vec2(2, -2)) + at(vec2(-2, 2)) + at(vec2(2, 2));
    vec3 sides = at(vec2(0, -2)) + at(vec2(-2, 0)) + at(vec2(2, 0)) + at(vec2(0, 2));
    result = vec4(0.125 * inner + 0.03125 * corners + 0.0625 * sides + 0.125 * at(vec2(0)), 1.0);
}
