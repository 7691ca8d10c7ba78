// Fresnel's equations for unpolarised light. Twins: scenes/optics/fresnel.py.
#include "brdf.glsl"
uniform float edge_tint;
uniform vec3 metal_n;
uniform vec3 metal_k;

// Walter et al. 2007, eq. 22; real index of at least 1.
vec3 f_dielectric(float cosine, vec3 index) {
    float c = clamp(cosine, 0.0, 1.0);
    vec3 g = sqrt(max(index * index - 1.0 + c * c, 0.0));
    vec3 across = (g - c) / max(g + c, 1e-20);
    vec3 along = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
    return 0.5 * across * across * (1.0 + along * along);
}

// Born & Wolf 1999, section 14.2, without complex numbers; index n + ik.
vec3 f_conductor(float cosine, vec3 n, vec3 k) {
    float c = clamp(cosine, 0.0, 1.0);
    float c2 = c * c;
    float s2 = 1.0 - c2;
    // (a + ib)² = (n + ik)² − sin². Of a² and b² the larger is a sum; the smaller would cancel as a difference.
    vec3 difference = (n - 1.0) * (n + 1.0) - k * k + c2;
    vec3 product = n * k;
    vec3 larger = 0.5 * (sqrt(difference * difference + 4.0 * product * product) + abs(difference));
    vec3 smaller = product * product / max(larger, 1e-20);
    bvec3 clear = greaterThan(difference, vec3(0.0));
    vec3 a = sqrt(mix(smaller, larger, clear));
    vec3 b2 = mix(larger, smaller, clear);
    vec3 across = ((a - c) * (a - c) + b2) / max((a + c) * (a + c) + b2, 1e-20);
    vec3 below = a * c - s2;
    vec3 above = a * c + s2;
    vec3 along = (below * below + b2 * c2) / max(above * above + b2 * c2, 1e-20);
    return 0.5 * across * (1.0 + along);
}

// The real index with that reflectance at normal incidence.
vec3 index_of(vec3 f0) {
    vec3 root = sqrt(min(f0, 0.9999));
    return (1.0 + root) / (1.0 - root);
}

// Gulbrandsen 2014, "Artist Friendly Metallic Fresnel", eq. 5–8: n, and k, with that reflectance at normal incidence.
vec3 complex_index_of(vec3 f0, float tint, out vec3 k) {
    vec3 root = sqrt(min(f0, 0.9999));
    vec3 square = root * root;
    vec3 n = mix((1.0 + root) / (1.0 - root), (1.0 - square) / (1.0 + square), tint);
    k = sqrt(max(2.0 * tint * root * (root * (n + 1.0) + n - 1.0) / ((1.0 - root) * (1.0 + square)), 0.0));
    return n;
}

// What follows are choices for a material's reflectance: a dielectric's and a metal's, mixed.

vec3 fresnel_schlick(float v_dot_h, vec3 base_color, float metallic, float specular) {
    return f_schlick(v_dot_h, reflectance_f0(base_color, metallic, specular), reflectance_f90(metallic, specular));
}

vec3 fresnel_none(float v_dot_h, vec3 base_color, float metallic, float specular) {
    return reflectance_f0(base_color, metallic, specular);
}

// A metal too has the real index of its colour.
vec3 fresnel_dielectric(float v_dot_h, vec3 base_color, float metallic, float specular) {
    return mix(f_dielectric(v_dot_h, index_of(vec3(0.04 * specular))),
               f_dielectric(v_dot_h, index_of(base_color)), metallic);
}

vec3 fresnel_conductor(float v_dot_h, vec3 base_color, float metallic, float specular) {
    vec3 k;
    vec3 n = complex_index_of(base_color, edge_tint, k);
    return mix(f_dielectric(v_dot_h, index_of(vec3(0.04 * specular))), f_conductor(v_dot_h, n, k), metallic);
}

// A metal by its measured index, whatever the base colour.
vec3 fresnel_metal(float v_dot_h, vec3 base_color, float metallic, float specular) {
    return mix(f_dielectric(v_dot_h, index_of(vec3(0.04 * specular))),
               f_conductor(v_dot_h, metal_n, metal_k), metallic);
}
