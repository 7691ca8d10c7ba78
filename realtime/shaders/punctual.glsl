// One punctual light, as realtime/punctual.py hands it over.
#include "lights.glsl"
uniform vec4 light_position; // w = 1: a position; w = 0: the direction to a light infinitely far away
uniform vec3 light_power;    // W/sr; W/m² for w = 0
uniform vec3 spot_direction;
uniform vec2 spot_cosines;   // inner, outer
uniform float inverse_range_square;

// The direction to the light, and the share of its power that arrives across it, 1/m² (1 for w = 0).
float received_at(vec3 position, out vec3 to_light) {
    to_light = light_position.xyz;
    if (light_position.w == 0.0) return 1.0;
    float received = from_position(light_position.xyz, position, to_light);
    received *= range_window(received, inverse_range_square);
    return received * spot_attenuation(-dot(to_light, spot_direction), spot_cosines.x, spot_cosines.y);
}
