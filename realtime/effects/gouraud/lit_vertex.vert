// Gives a vertex the light that was reflected there; the rasteriser interpolates it with perspective.
uniform mat4 view_projection;
uniform sampler2D vertex_light;
uniform int first_vertex;
in vec3 position;
out vec3 light;

void main() {
    int number = first_vertex + gl_VertexID;
    ivec2 size = textureSize(vertex_light, 0); // whose first row is the top one, as a picture's is
    light = texelFetch(vertex_light, ivec2(number % size.x, size.y - 1 - number / size.x), 0).rgb;
    gl_Position = view_projection * vec4(position, 1.0);
}
