// Radiance reflected from an emissive surface, summed over points on it.
#include "brdf.glsl"
uniform sampler2D light_points; // a row per pixel of the tile; position, normal, radiance · area / count of each point
uniform bool two_sided;

// cos θ/d² of what leaves a patch of the light's surface, and the direction to it; 0 on the patch itself.
float received_from(vec3 offset, vec3 normal, bool both_sides, out vec3 direction) {
    float square = dot(offset, offset);
    direction = square > 0.0 ? offset * inversesqrt(square) : vec3(0.0);
    float cos_light = -dot(direction, normal);
    cos_light = both_sides ? abs(cos_light) : max(cos_light, 0.0);
    return square > 0.0 ? cos_light / square : 0.0;
}

vec3 direct(Surface surface) {
    ivec2 cell = ivec2(gl_FragCoord.xy) % TILE;
    int row = cell.y * TILE + cell.x;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < SAMPLES; ++i) {
        vec3 position = texelFetch(light_points, ivec2(3 * i, row), 0).xyz;
        vec3 normal = texelFetch(light_points, ivec2(3 * i + 1, row), 0).xyz;
        vec3 weight = texelFetch(light_points, ivec2(3 * i + 2, row), 0).xyz;
        vec3 to_light;
        float received = received_from(position - surface.position, normal, two_sided, to_light);
        sum += weight * received * gltf_brdf(surface.base_color, surface.metallic, surface.roughness, surface.specular,
                                             surface.normal, surface.view, to_light);
    }
    return sum;
}
