#include "luminance.glsl"
uniform sampler2D image;
uniform float floor_luminance;
uniform float side;
out vec4 result;

void main() {
    vec3 color = texture(image, gl_FragCoord.xy / side).rgb;
    result = vec4(log2(max(luminance(color), floor_luminance)));
}
