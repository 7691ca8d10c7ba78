// Other distributions and maskings than the material's own. Twins: scenes/optics/microfacet.py.
#include "brdf.glsl"
#include "cosine_power.glsl"

// Walter et al. 2007, eq. 25.
float d_beckmann(float n_dot_h, float sin2_h, float alpha) {
    if (n_dot_h <= 0.0) return 0.0;
    float cosine2 = max(n_dot_h * n_dot_h, 1e-14);
    float a2 = alpha * alpha;
    return exp(-sin2_h / (cosine2 * a2)) / (PI * a2 * cosine2 * cosine2);
}

// Walter et al. 2007, eq. 30.
float d_blinn(float n_dot_h, float sin2_h, float alpha) {
    float exponent = blinn_exponent(alpha);
    return (exponent + 2.0) / (2.0 * PI) * cosine_power(n_dot_h, sin2_h, exponent);
}

// Walter et al. 2007, eq. 23 and 34, over 4·n·v·n·l.
float v_smith_ggx_separable(float n_dot_v, float n_dot_l, float alpha) {
    float a2 = alpha * alpha;
    float toward_v = n_dot_v + sqrt(n_dot_v * n_dot_v * (1.0 - a2) + a2);
    float toward_l = n_dot_l + sqrt(n_dot_l * n_dot_l * (1.0 - a2) + a2);
    return 1.0 / (toward_v * toward_l);
}

// Schlick 1994, eq. 19, over 4·n·v·n·l.
float v_schlick(float n_dot_v, float n_dot_l, float k) {
    return 0.25 / ((n_dot_v * (1.0 - k) + k) * (n_dot_l * (1.0 - k) + k));
}

// Karis 2013, "Real Shading in Unreal Engine 4": nearest to Smith's.
float v_schlick_half(float n_dot_v, float n_dot_l, float alpha) {
    return v_schlick(n_dot_v, n_dot_l, 0.5 * alpha);
}

// Karis 2013, for analytic lights: α of a roughness moved half way to 1 (Burley's remapping).
float v_schlick_remapped(float n_dot_v, float n_dot_l, float alpha) {
    float widened = sqrt(alpha) + 1.0;
    return v_schlick(n_dot_v, n_dot_l, widened * widened * 0.125);
}

// Hammon 2017, "PBR Diffuse Lighting for GGX+Smith Microsurfaces".
float v_smith_ggx_fast(float n_dot_v, float n_dot_l, float alpha) {
    return 0.5 / max(mix(2.0 * n_dot_l * n_dot_v, n_dot_l + n_dot_v, alpha), 1e-30);
}

// Hoffman 2010, "Crafting Physically Motivated Shading Models": G = n·v·n·l.
float v_implicit(float n_dot_v, float n_dot_l, float alpha) {
    return 0.25;
}
