// The second bounce: points all over the scene pass on what the first virtual lights send them; those are kept as they are.
#include "surface.glsl"
#include "received.glsl"
uniform sampler2D surface_points; // rows: position, normal, reflectance · area
layout(location = 0) out vec4 out_position;
layout(location = 1) out vec4 out_normal;
layout(location = 2) out vec4 out_power;

void main() {
    int column = int(gl_FragCoord.x);
    if (column < FIRST) {
        out_position = texelFetch(virtual_position, ivec2(column, 0), 0);
        out_normal = texelFetch(virtual_normal, ivec2(column, 0), 0);
        out_power = texelFetch(virtual_power, ivec2(column, 0), 0);
        return;
    }
    vec3 position = texelFetch(surface_points, ivec2(column - FIRST, 0), 0).xyz;
    vec3 normal = texelFetch(surface_points, ivec2(column - FIRST, 1), 0).xyz;
    vec3 reflects = texelFetch(surface_points, ivec2(column - FIRST, 2), 0).rgb;
    vec3 irradiance = vec3(0.0);
    for (int light = 0; light < FIRST; ++light) {
        vec3 to_light;
        vec3 arrives = arriving(light, position, normal, to_light);
        irradiance += arrives * max(dot(normal, to_light), 0.0);
    }
    out_position = vec4(position, 1.0);
    out_normal = vec4(normal, 0.0);
    out_power = vec4(irradiance * reflects * (1.0 / PI), 0.0);
}
