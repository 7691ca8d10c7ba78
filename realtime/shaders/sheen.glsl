// Sheen of cloth: KHR_materials_sheen. Twins: scenes/optics/sheen.py.
#include "brdf.glsl"
uniform sampler2D sheen_table; // x: √(n·v), y: roughness; r: the lobe's albedo

// Estevez & Kulla 2017, "Production Friendly Microfacet Sheen BRDF", eq. 2. sin2_h is |n × h|².
float d_charlie(float n_dot_h, float sin2_h, float alpha) {
    if (n_dot_h <= 0.0) return 0.0;
    float inverse = 1.0 / alpha;
    return (2.0 + inverse) * exp(0.5 * inverse * log(max(sin2_h, 1e-30))) * (1.0 / (2.0 * PI));
}

// Their fit of ln Λ up to 60° (eq. 3, table 1).
float sheen_curve(float x, float alpha) {
    float t = (1.0 - alpha) * (1.0 - alpha);
    float a = mix(21.5473, 25.3245, t);
    float b = mix(3.82987, 3.32435, t);
    float c = mix(0.19823, 0.16801, t);
    float d = mix(-1.97760, -1.27393, t);
    float e = mix(-4.32054, -4.85967, t);
    return a / (1.0 + b * exp(c * log(max(x, 1e-30)))) + d * x + e;
}

// Λ of Smith's masking, the fit mirrored at 60°.
float sheen_shadowing(float cosine, float alpha) {
    if (cosine < 0.5) return exp(sheen_curve(cosine, alpha));
    return exp(2.0 * sheen_curve(0.5, alpha) - sheen_curve(1.0 - cosine, alpha));
}

// D·V·(n·l), 1/sr: the sheen as if it were white.
float sheen_lobe(float roughness, vec3 n, vec3 v, vec3 l) {
    float n_dot_v = dot(n, v);
    float n_dot_l = dot(n, l);
    if (n_dot_v <= 0.0 || n_dot_l <= 0.0) return 0.0;
    vec3 cosines = half_cosines(n, v, l);
    float alpha = max(roughness * roughness, MIN_ALPHA);
    float to_v = max(n_dot_v, 1e-6);
    float to_l = max(n_dot_l, 1e-6);
    float masked = 1.0 + sheen_shadowing(to_v, alpha) + sheen_shadowing(to_l, alpha);
    return d_charlie(cosines.x, cosines.y, alpha) * 0.25 / (masked * to_v);
}

float sheen_albedo(float cosine, float roughness) {
    vec2 size = vec2(textureSize(sheen_table, 0));
    return texture(sheen_table, (vec2(sqrt(clamp(cosine, 0.0, 1.0)), roughness) * (size - 1.0) + 0.5) / size).r;
}

// What a sheen leaves of its base, given its albedos towards v and l (or that towards v twice).
float sheen_scaling(vec3 color, float albedo_v, float albedo_l) {
    return max(1.0 - max(max(color.r, color.g), color.b) * max(albedo_v, albedo_l), 0.0);
}

// f·(n·l) of a base under a sheen, 1/sr.
vec3 with_sheen(vec3 base, vec3 color, float roughness, vec3 n, vec3 v, vec3 l) {
    float left = sheen_scaling(color, sheen_albedo(dot(n, v), roughness), sheen_albedo(dot(n, l), roughness));
    return color * sheen_lobe(roughness, n, v, l) + base * left;
}
