// A shape as the light sees it.
uniform mat4 view_projection;
in vec3 position;
#ifdef ALPHA_MASK
in vec2 texcoord0;
out vec2 uv0;
#ifdef HAS_TEXCOORD1
in vec2 texcoord1;
out vec2 uv1;
#endif
#endif

void main() {
#ifdef ALPHA_MASK
    uv0 = texcoord0;
#ifdef HAS_TEXCOORD1
    uv1 = texcoord1;
#endif
#endif
    gl_Position = view_projection * vec4(position, 1.0);
}
