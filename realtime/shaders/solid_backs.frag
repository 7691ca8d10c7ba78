// What is turned away from the viewer; what faces them is left out.
in vec3 world_position;
in vec3 vertex_normal;
layout(location = 0) out vec4 out_normal;
layout(location = 1) out vec4 out_position;

void main() {
    if (gl_FrontFacing) discard;
    out_normal = vec4(normalize(vertex_normal), 1.0);
    out_position = vec4(world_position, 1.0);
}
