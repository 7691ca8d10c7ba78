// What virtual lights send to a point.
#include "lobes.glsl"
#include "patches.glsl"
uniform float nearest; // metres: none counts as nearer

#ifdef MAPS
uniform sampler2D virtual_depths;

// Whether something lies between a virtual light and a point. The point is moved along its normal by a texel and a
// half, as wide as it is there, so that its own surface does not hide it.
bool hidden(int light, vec3 light_position, vec3 light_normal, vec3 position, vec3 normal) {
    float texel = 2.0 * WIDTH / float(MAP_SIZE);
    float away = max(dot(position - light_position, light_normal), 0.0);
    vec3 seen = along_axes(position + normal * (1.5 * texel * away) - light_position, light_normal);
    vec2 place = seen.xy / (seen.z * WIDTH);
    if (seen.z <= planes.x || any(greaterThanEqual(abs(place), vec2(1.0)))) return false;
    ivec2 corner = MAP_SIZE * ivec2(light % MAP_COLUMNS, light / MAP_COLUMNS);
    ivec2 within = ivec2((place * 0.5 + 0.5) * float(MAP_SIZE));
    return axial_depth(texelFetch(virtual_depths, corner + within, 0).r, planes) < seen.z;
}
#endif

// f·cos for light from a direction, 1/sr.
vec3 all_lobes(Surface surface, vec3 to_light) {
    return gltf_brdf(surface.base_color, surface.metallic, surface.roughness, surface.specular, surface.normal,
                     surface.view, to_light);
}

vec3 diffuse_only(Surface surface, vec3 to_light) {
    return diffuse_lobe(surface.base_color, surface.metallic, surface.specular, surface.view, to_light) *
           max(dot(surface.normal, to_light), 0.0);
}

// W/m²·sr⁻¹ that arrives from one virtual light across the direction to it.
vec3 arriving(int light, vec3 position, vec3 normal, out vec3 to_light) {
    vec3 light_position = texelFetch(virtual_position, ivec2(light, 0), 0).xyz;
    vec3 light_normal = texelFetch(virtual_normal, ivec2(light, 0), 0).xyz;
    vec3 power = texelFetch(virtual_power, ivec2(light, 0), 0).rgb;
    float received = received_from(light_position - position, light_normal, nearest, to_light);
#ifdef MAPS
    if (received > 0.0 && hidden(light, light_position, light_normal, position, normal)) received = 0.0;
#endif
    return power * received;
}

// Radiance reflected from every `step`th virtual light.
vec3 reflected(Surface surface, int first, int step, int count) {
    vec3 sum = vec3(0.0);
    for (int light = first; light < count; light += step) {
        vec3 to_light;
        vec3 arrives = arriving(light, surface.position, surface.normal, to_light);
        sum += arrives * LOBES(surface, to_light);
    }
    return sum;
}
