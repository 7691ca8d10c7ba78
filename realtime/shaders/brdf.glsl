// The material's reflection: glTF 2.0, Appendix B. Twin: scenes/optics (microfacet.py, material.py).
const float PI = 3.14159265358979;
const float MIN_ALPHA = 1e-3;

// (n·h, |n × h|², v·h) of the half vector h between v and l.
vec3 half_cosines(vec3 n, vec3 v, vec3 l) {
    vec3 sum = v + l;
    vec3 h = sum * inversesqrt(max(dot(sum, sum), 1.2e-38));
    vec3 n_cross_h = cross(n, h);
    return vec3(dot(n, h), dot(n_cross_h, n_cross_h), dot(v, h));
}

// Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", eq. 33. sin2_h is |n × h|²: the
// textbook's cos²·(α² − 1) + 1 cancels for small α.
float d_ggx(float n_dot_h, float sin2_h, float alpha) {
    if (n_dot_h <= 0.0) return 0.0;
    float k = alpha / (n_dot_h * n_dot_h * alpha * alpha + sin2_h);
    return k * k * (1.0 / PI);
}

// Heitz 2014, "Understanding the Masking-Shadowing Function", eq. 99, over 4·n·v·n·l.
float v_smith_ggx_correlated(float n_dot_v, float n_dot_l, float alpha) {
    float a2 = alpha * alpha;
    float lambda_v = n_dot_l * sqrt(n_dot_v * n_dot_v * (1.0 - a2) + a2);
    float lambda_l = n_dot_v * sqrt(n_dot_l * n_dot_l * (1.0 - a2) + a2);
    return 0.5 / max(lambda_v + lambda_l, 1e-30);
}

// Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering", eq. 15.
vec3 f_schlick(float v_dot_h, vec3 f0, vec3 f90) {
    float m = clamp(1.0 - v_dot_h, 0.0, 1.0);
    float m2 = m * m;
    return f0 + (f90 - f0) * (m2 * m2 * m);
}

vec3 diffuse_color(vec3 base_color, float metallic) {
    return base_color * (1.0 - metallic);
}

vec3 reflectance_f0(vec3 base_color, float metallic, float specular) {
    return mix(vec3(0.04 * specular), base_color, metallic);
}

vec3 reflectance_f90(float metallic, float specular) {
    return vec3(mix(specular, 1.0, metallic));
}

// f(v, l)·(n·l), 1/sr. A whole dielectric is mixed with a whole metal: what dims the diffuse part is the dielectric's
// Fresnel reflectance alone.
vec3 gltf_brdf(vec3 base_color, float metallic, float roughness, float specular, vec3 n, vec3 v, vec3 l) {
    float n_dot_v = dot(n, v);
    float n_dot_l = dot(n, l);
    if (n_dot_v <= 0.0 || n_dot_l <= 0.0) return vec3(0.0);
    vec3 half_vector = half_cosines(n, v, l);
    float alpha = max(roughness * roughness, MIN_ALPHA);
    float d = d_ggx(half_vector.x, half_vector.y, alpha);
    float visible = v_smith_ggx_correlated(max(n_dot_v, 1e-7), max(n_dot_l, 1e-7), alpha);
    vec3 fresnel = f_schlick(half_vector.z, reflectance_f0(base_color, metallic, specular),
                             reflectance_f90(metallic, specular));
    vec3 above = f_schlick(half_vector.z, vec3(0.04 * specular), vec3(specular));
    return ((1.0 - above) * diffuse_color(base_color, metallic) * (1.0 / PI) + fresnel * (d * visible)) * n_dot_l;
}
