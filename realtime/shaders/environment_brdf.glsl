// Scale and bias of F0 in GGX's directional albedo: a fit for mobile hardware (Karis 2014, "Physically Based Shading on
// Mobile"; every constant is its).
vec2 environment_brdf(float roughness, float n_dot_v) {
    vec4 r = roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a004 = min(r.x * r.x, exp2(-9.28 * n_dot_v)) * r.x + r.y;
    return vec2(-1.04, 1.04) * a004 + r.zw;
}
