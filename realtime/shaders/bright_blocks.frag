// The bright part of a picture, averaged over blocks of pixels.
#include "bright_part.glsl"
uniform sampler2D image;
uniform float threshold;
uniform int divisor;
out vec4 result;

void main() {
    ivec2 first = ivec2(gl_FragCoord.xy) * divisor, last = textureSize(image, 0) - 1;
    vec3 sum = vec3(0.0);
    for (int y = 0; y < divisor; y++)
        for (int x = 0; x < divisor; x++)
            sum += bright_part(texelFetch(image, min(first + ivec2(x, y), last), 0).rgb, threshold);
    result = vec4(sum / float(divisor * divisor), 1.0);
}
