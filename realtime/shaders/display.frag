// The full-screen pass of a display effect: tone or encode, pixel by pixel.
EFFECT
uniform sampler2D image;
uniform float exposure_scale;
#ifdef METERED
uniform sampler2D metered;  // one texel: log2 of the average luminance
#endif
#ifdef DITHER
#include "dither.glsl"
#endif
out vec4 result;

void main() {
    float scale = exposure_scale;
#ifdef METERED
    scale *= exp2(-texelFetch(metered, ivec2(0), 0).r);
#endif
    result = vec4(FUNCTION(texelFetch(image, ivec2(gl_FragCoord.xy), 0).rgb * scale), 1.0);
#ifdef DITHER
    vec2 pixel = floor(gl_FragCoord.xy);
    result.rgb += (DITHER - 0.5) / 255.0;  // the target rounds to whole codes
#endif
}
