// Irradiance of polygons of even radiance (Lambert 1760, "Photometria"): the vector whose component along any normal is
// that plane's irradiance. Twin: twin.py.
//
// A polygon's corners come as offsets from one point, `base`, as seen from the receiver: a side is then a difference of
// offsets, whose digits a small light far away would else lose in the difference of two directions.

// θ/sin θ from cos θ = x; for x ≥ 0 a rational fit, good to 2e-8, beyond that π − θ is the angle.
float angle_over_sine(float x) {
    float y = abs(x);
    float f = (1.57079629 + y * (1.33067588 + y * 0.18455714)) /
              (1.0 + y * (1.48375225 + y * (0.56211378 + y * 0.04016334)));
    return x >= 0.0 ? f : 3.14159265 * inversesqrt(max(1.0 - y * y, 1e-7)) - f;
}

// What the side from a to b adds, times 2: θ·(b × a)/|b × a|, for corners that run anticlockwise seen from the front.
vec3 side_irradiance(vec3 base, vec3 a, vec3 b) {
    vec3 from = base + a;
    vec3 to = base + b;
    float scale = inversesqrt(max(dot(from, from) * dot(to, to), 1e-30));
    return cross(b - a, from) * (angle_over_sine(dot(from, to) * scale) * scale);
}

// Where the side from a to b, with heights of opposite signs, meets the horizon.
vec3 on_horizon(vec3 a, vec3 b, float height_a, float height_b) {
    return a + (b - a) * (height_a / (height_a - height_b));
}
