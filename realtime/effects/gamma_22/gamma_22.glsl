// x^(1/γ).
uniform float gamma;

vec3 gamma_encode(vec3 linear, float exponent) {
    return pow(clamp(linear, 0.0, 1.0), vec3(1.0 / exponent));
}

vec3 encode(vec3 linear) {
    return gamma_encode(linear, gamma);
}
