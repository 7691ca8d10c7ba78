// Directions of the specular lobe and what they carry; the base under constant ambient light.
#include "brdf.glsl"

// A microfacet normal seen from v in the frame of the surface's normal (+z), with density G1·max(0, v·h)·D/(n·v)
// (Heitz 2018, Sampling the GGX Distribution of Visible Normals, listing 1); twin: scenes/optics/microfacet.py.
vec3 visible_normal(vec3 v, float alpha, float u1, float u2) {
    vec3 vh = normalize(vec3(alpha * v.x, alpha * v.y, v.z));
    float square = dot(vh.xy, vh.xy);
    vec3 t1 = square > 0.0 ? vec3(-vh.y, vh.x, 0.0) * inversesqrt(square) : vec3(1.0, 0.0, 0.0);
    vec3 t2 = cross(vh, t1);
    float radius = sqrt(u1), phi = 2.0 * PI * u2;
    float p1 = radius * cos(phi);
    float s = 0.5 * (1.0 + vh.z);
    float p2 = (1.0 - s) * sqrt(max(1.0 - p1 * p1, 0.0)) + s * (radius * sin(phi));
    float p3 = sqrt(max(1.0 - p1 * p1 - p2 * p2, 0.0));
    vec3 h = p1 * t1 + p2 * t2 + p3 * vh;
    return normalize(vec3(alpha * h.x, alpha * h.y, max(h.z, 1e-6)));
}

// f·(n·l) of the specular lobe over the density of a direction mirrored at a visible normal, without Fresnel: G2/G1
// (Heitz 2018, eq. 19).
float shadowed_share(float n_dot_v, float n_dot_l, float alpha) {
    float a2 = alpha * alpha;
    float toward_v = n_dot_v + sqrt(n_dot_v * n_dot_v * (1.0 - a2) + a2);
    return v_smith_ggx_correlated(n_dot_v, n_dot_l, alpha) * 2.0 * n_dot_l * toward_v;
}

// What the base reflects of light that comes from everywhere, what the interface mirrors at the viewer's angle left out.
vec3 ambient_base(vec3 base_color, float metallic, float specular, float n_dot_v) {
    return (1.0 - f_schlick(n_dot_v, vec3(0.04 * specular), vec3(specular))) * diffuse_color(base_color, metallic);
}

// Two unit vectors that make a right-handed frame (s, t, n) (Duff et al. 2017, Building an Orthonormal Basis, Revisited,
// listing 3).
vec3 basis(vec3 n, out vec3 t) {
    float side = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (side + n.z);
    float b = n.x * n.y * a;
    t = vec3(b, side + n.y * n.y * a, -n.y);
    return vec3(1.0 + side * n.x * n.x * a, side * b, -side * n.x);
}
