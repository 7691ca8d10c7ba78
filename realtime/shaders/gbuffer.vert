// Places a vertex; positions come in world space, so that both renderers see the same triangles.
uniform mat4 view_projection;
in vec3 position;
out vec3 world_position;
in vec3 normal;
out vec3 vertex_normal;
#ifdef HAS_TEXCOORD0
in vec2 texcoord0;
out vec2 uv0;
#endif
#ifdef HAS_TEXCOORD1
in vec2 texcoord1;
out vec2 uv1;
#endif
#ifdef HAS_TANGENT
in vec4 tangent;
out vec4 vertex_tangent;
#endif
#ifdef HAS_COLOR
in vec4 color;
out vec4 vertex_color;
#endif

void main() {
    world_position = position;
    vertex_normal = normal;
#ifdef HAS_TEXCOORD0
    uv0 = texcoord0;
#endif
#ifdef HAS_TEXCOORD1
    uv1 = texcoord1;
#endif
#ifdef HAS_TANGENT
    vertex_tangent = tangent;
#endif
#ifdef HAS_COLOR
    vertex_color = color;
#endif
    gl_Position = view_projection * vec4(position, 1.0);
}
