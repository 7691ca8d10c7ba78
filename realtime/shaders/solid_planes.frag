// A solid's tangent planes as they are seen from its middle.
uniform vec3 middle;
in vec3 world_position;
in vec3 vertex_normal;
out vec4 plane;

void main() {
    vec3 normal = normalize(vertex_normal);
    plane = vec4(normal, dot(normal, world_position - middle));
}
