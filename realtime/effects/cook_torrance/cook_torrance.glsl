// Radiance reflected from one punctual light, without its shadow.
#include "brdf.glsl"
#include "lights.glsl"
uniform vec4 light_position; // w = 1: a position; w = 0: the direction to a light infinitely far away
uniform vec3 light_power;    // W/sr; W/m² for w = 0
uniform vec3 spot_direction;
uniform vec2 spot_cosines;   // inner, outer
uniform float inverse_range_square;

vec3 direct(Surface surface) {
    vec3 to_light = light_position.xyz;
    float received = 1.0;
    if (light_position.w > 0.0) {
        received = from_position(light_position.xyz, surface.position, to_light);
        received *= range_window(received, inverse_range_square);
        received *= spot_attenuation(-dot(to_light, spot_direction), spot_cosines.x, spot_cosines.y);
    }
    return light_power * received * gltf_brdf(surface.base_color, surface.metallic, surface.roughness,
                                              surface.specular, surface.normal, surface.view, to_light);
}
