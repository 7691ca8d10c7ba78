// The full-screen pass of an effect: loads the surface, calls the effect's function for each term it writes, and
// either adds their composition to the frame's radiance or writes each term to an attachment of its own. Where nothing
// is seen the result is chosen away, not discarded: to a software rasteriser masks cost more than arithmetic.
#include "surface.glsl"
EFFECT
#ifdef READS_VISIBILITY
uniform sampler2D visibility_buffer;
#endif
#ifdef READS_ENVIRONMENT_VISIBILITY
uniform sampler2D environment_visibility_buffer;
#endif
OUTPUTS

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    Surface surface;
    bool seen = load_surface(pixel, surface);
    WRITES
}
