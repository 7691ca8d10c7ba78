// A shape as the light sees it. A masked one has holes: alpha from the factor, the vertices and the texture, as in
// gbuffer.frag.
#ifdef MASKED
#include "textures.glsl"
uniform vec4 base_color_factor;
uniform float alpha_cutoff;
#ifdef HAS_TEXCOORD0
in vec2 uv0;
#endif
#ifdef HAS_TEXCOORD1
in vec2 uv1;
#endif
#ifdef HAS_COLOR
in vec4 vertex_color;
#endif
TEXTURE_DECLARATIONS
#endif
KEPT

void main() {
#ifdef MASKED
    float alpha = base_color_factor.a;
#ifdef HAS_COLOR
    alpha *= vertex_color.a;
#endif
#ifdef TEXTURE_BASE_COLOR
    alpha *= look_up_base_color().a;
#endif
    if (alpha < alpha_cutoff) discard;
#endif
    keep();
}
