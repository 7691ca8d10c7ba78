// Punctual lights (KHR_lights_punctual, read as radiometric). Twin: scenes/optics/lights.py.

// 1/d² towards a light, and the unit direction to it; both 0 at the light itself.
float from_position(vec3 light_position, vec3 point, out vec3 direction) {
    vec3 offset = light_position - point;
    float square = dot(offset, offset);
    direction = square > 0.0 ? offset * inversesqrt(square) : vec3(0.0);
    return square > 0.0 ? 1.0 / square : 0.0;
}

// 1 − (d/r)⁴, 0 beyond the range r: glTF's recommended window. `inverse_range_square` is 0 where there is no range.
float range_window(float inverse_square, float inverse_range_square) {
    float ratio = inverse_range_square / max(inverse_square, 1e-18);
    return max(1.0 - ratio * ratio, 0.0);
}

float spot_attenuation(float cos_angle, float cos_inner, float cos_outer) {
    float ramp = clamp((cos_angle - cos_outer) / max(1e-3, cos_inner - cos_outer), 0.0, 1.0);
    return ramp * ramp;
}
