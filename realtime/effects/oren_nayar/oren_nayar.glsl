// Radiance reflected from one punctual light, without its shadow. Twin: scenes/optics/oren_nayar.py.
#include "brdf.glsl"
#include "punctual.glsl"
uniform float spread;
const float MEAN_1 = 0.5 - 2.0 / (3.0 * PI);
const float MEAN_2 = 2.0 / 3.0 - 28.0 / (15.0 * PI);

// Oren & Nayar 1994, eq. 30 and 31, over n·l: light once and twice reflected by the grooves. Vectors: to v, to l.
vec3 grooves(vec3 rho, float sigma, vec2 angles, vec2 sines, vec2 cosines, float cos_phi) {
    float flatter = min(angles.x, angles.y);
    float s2 = sigma * sigma;
    float tan_flatter = min(sines.x, sines.y) / max(cosines.x, cosines.y);
    // tan of half the sum of two angles is the sum of the sines over that of the cosines.
    float tan_mean = (sines.x + sines.y) / (cosines.x + cosines.y);
    float backward = 2.0 * flatter * (1.0 / PI);
    float c1 = 1.0 - 0.5 * s2 / (s2 + 0.33);
    float opposed = cos_phi < 0.0 ? backward * backward * backward : 0.0;
    float c2 = 0.45 * s2 / (s2 + 0.09) * (max(sines.x, sines.y) - opposed);
    float both = 4.0 * angles.x * angles.y * (1.0 / (PI * PI));
    float c3 = 0.125 * s2 / (s2 + 0.09) * (both * both);
    float once = c1 + cos_phi * c2 * tan_flatter + max(1.0 - abs(cos_phi), 0.0) * c3 * tan_mean;
    float twice = 0.17 * s2 / (s2 + 0.13) * (1.0 - cos_phi * backward * backward);
    // Negative where both graze from opposite sides.
    return rho * (1.0 / PI) * max(once + rho * twice, 0.0);
}

// All below: f·(n·l), 1/sr, for n·v > 0 and n·l > 0.

vec3 oren_nayar_full(vec3 rho, float sigma, vec3 n, vec3 v, vec3 l) {
    vec2 cosines = max(vec2(dot(n, v), dot(n, l)), 1e-7);
    vec3 n_cross_v = cross(n, v);
    vec3 n_cross_l = cross(n, l);
    vec2 sines = vec2(length(n_cross_v), length(n_cross_l));
    float cos_phi = dot(n_cross_v, n_cross_l) / max(sines.x * sines.y, 1e-14);
    return grooves(rho, sigma, atan(sines, cosines), sines, cosines, cos_phi) * cosines.y;
}

// sin θᵥ·sin θₗ·cos φ: v·l − (n·v)(n·l) without its cancellation.
float lean(vec3 n, vec3 v, vec3 l) {
    return dot(cross(n, v), cross(n, l));
}

// Oren & Nayar 1994, eq. 32.
vec3 oren_nayar_qualitative(vec3 rho, float sigma, vec3 n, vec3 v, vec3 l) {
    float s2 = sigma * sigma;
    float a = 1.0 - 0.5 * s2 / (s2 + 0.33);
    float b = 0.45 * s2 / (s2 + 0.09);
    float toward = max(lean(n, v, l), 0.0) / max(max(dot(n, v), dot(n, l)), 1e-7);
    return rho * (1.0 / PI) * (a + b * toward) * dot(n, l);
}

// Fujii 2012.
vec3 oren_nayar_fujii(vec3 rho, float roughness, vec3 n, vec3 v, vec3 l) {
    float along = lean(n, v, l);
    float toward = along > 0.0 ? along / max(max(dot(n, v), dot(n, l)), 1e-7) : along;
    return rho * (1.0 / PI) / (1.0 + MEAN_1 * roughness) * (1.0 + roughness * toward) * dot(n, l);
}

// Portsmouth, Kutz & Hill 2024, listing 1, approximate.
float fujii_albedo(float cosine, float roughness) {
    float m = 1.0 - cosine;
    float g = m * (0.0571085289 + m * (0.491881867 + m * (-0.332181442 + m * 0.0714429953)));
    return (1.0 + roughness * g) / (1.0 + MEAN_1 * roughness);
}

// Portsmouth, Kutz & Hill 2024, listing 1.
vec3 oren_nayar_eon(vec3 rho, float roughness, vec3 n, vec3 v, vec3 l) {
    float mean = (1.0 + MEAN_2 * roughness) / (1.0 + MEAN_1 * roughness);
    vec3 again = rho * rho * mean / (1.0 - rho * (1.0 - mean));
    float lost_v = max(1.0 - fujii_albedo(max(dot(n, v), 1e-7), roughness), 1e-7);
    float lost_l = max(1.0 - fujii_albedo(max(dot(n, l), 1e-7), roughness), 1e-7);
    vec3 lobe = again * (1.0 / PI) * lost_v * lost_l / max(1.0 - mean, 1e-7);
    return oren_nayar_fujii(rho, roughness, n, v, l) + lobe * dot(n, l);
}

vec3 direct(Surface surface) {
    vec3 to_light;
    float received = received_at(surface.position, to_light);
    if (dot(surface.normal, to_light) <= 0.0) return vec3(0.0);
    return light_power * received * FORM(surface.base_color, surface.roughness * spread, surface.normal, surface.view, to_light);
}
