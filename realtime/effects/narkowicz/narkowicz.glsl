// Narkowicz 2016: (x(2.51x + 0.03)) / (x(2.43x + 0.59) + 0.14).
uniform float prescale;

vec3 narkowicz(vec3 radiance, float scale) {
    // Beyond 1e4 the curve is 1 to 1e-4, clipped; x² would overflow far out.
    vec3 x = clamp(radiance * scale, 0.0, 1e4);
    return clamp((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

vec3 tone(vec3 radiance) {
    return narkowicz(radiance, prescale);
}
