// The scene as one virtual light sees it: a wide view along its normal.
#include "patches.glsl"
uniform int light;
in vec3 position;

void main() {
    vec3 light_position = texelFetch(virtual_position, ivec2(light, 0), 0).xyz;
    vec3 seen = along_axes(position - light_position, texelFetch(virtual_normal, ivec2(light, 0), 0).xyz);
    float depth = (planes.y + planes.x) * seen.z - 2.0 * planes.x * planes.y;
    gl_Position = vec4(seen.xy / WIDTH, depth / (planes.y - planes.x), seen.z);
}
