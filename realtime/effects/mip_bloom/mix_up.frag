// A picture, and in part a smaller one, spread by a tent of 3 × 3 of its pixels.
uniform sampler2D image;
uniform sampler2D smaller;
uniform float share;
out vec4 result;

vec3 at(vec2 offset) {
    return texture(smaller, gl_FragCoord.xy / vec2(textureSize(image, 0)) + offset / vec2(textureSize(smaller, 0))).rgb;
}

void main() {
    vec3 tent = 4.0 * at(vec2(0));
    tent += 2.0 * (at(vec2(-1, 0)) + at(vec2(1, 0)) + at(vec2(0, -1)) + at(vec2(0, 1)));
    tent += at(vec2(-1, -1)) + at(vec2(1, -1)) + at(vec2(-1, 1)) + at(vec2(1, 1));
    result = vec4(mix(texelFetch(image, ivec2(gl_FragCoord.xy), 0).rgb, tent / 16.0, share), 1.0);
}
