// A picture, and to it one of blocks of its pixels, interpolated.
uniform sampler2D image;
uniform sampler2D blocks;
uniform int divisor;
uniform float strength;
out vec4 result;

void main() {
    vec2 place = gl_FragCoord.xy / (vec2(textureSize(blocks, 0)) * float(divisor));
    result = vec4(texelFetch(image, ivec2(gl_FragCoord.xy), 0).rgb + strength * texture(blocks, place).rgb, 1.0);
}
