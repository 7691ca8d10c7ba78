// The full-screen pass of a display effect: tone or encode, pixel by pixel.
EFFECT
uniform sampler2D image;
uniform float exposure_scale;
out vec4 result;

void main() {
    result = vec4(FUNCTION(texelFetch(image, ivec2(gl_FragCoord.xy), 0).rgb * exposure_scale), 1.0);
}
