uniform float prescale;

// Rows: Rec. 709 to the space that the curve is applied in, and back (Hill 2016).
const mat3 INTO = transpose(mat3(0.59719, 0.35458, 0.04823, 0.07600, 0.90834, 0.01566, 0.02840, 0.13383, 0.83777));
const mat3 BACK = transpose(mat3(1.60475, -0.53108, -0.07367, -0.10208, 1.10813, -0.00605, -0.00327, -0.07276, 1.07602));

vec3 hill(vec3 radiance, float scale) {
    // Beyond 1e6 the curve is level to 1e-6; v² would overflow far out.
    vec3 v = INTO * clamp(radiance * scale, 0.0, 1e6);
    vec3 curve = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return clamp(BACK * curve, 0.0, 1.0);
}

vec3 tone(vec3 radiance) {
    return hill(radiance, prescale);
}
