// GGX with two roughnesses: KHR_materials_anisotropy. Twins: scenes/optics/anisotropy.py, frames.py.
#include "brdf.glsl"

// A direction turned by another's angle.
vec2 turned(vec2 by, vec2 direction) {
    return vec2(by.x * direction.x - by.y * direction.y, by.y * direction.x + by.x * direction.y);
}

// A unit vector across n (Duff et al. 2017, "Building an Orthonormal Basis, Revisited", listing 3).
vec3 across(vec3 n) {
    float side = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (side + n.z);
    return vec3(1.0 + side * n.x * n.x * a, side * n.x * n.y * a, -side * n.x);
}

// The unit direction grain.x·t + grain.y·b of MikkTSpace's frame, laid across the shading normal.
vec3 along_grain(vec3 tangent, float bitangent_sign, vec3 normal, vec3 shading_normal, vec2 grain) {
    vec3 direction = grain.x * tangent + grain.y * (bitangent_sign < 0.0 ? -1.0 : 1.0) * cross(normal, tangent);
    direction -= dot(direction, shading_normal) * shading_normal;
    float square = dot(direction, direction);
    return square > 1e-12 ? direction * inversesqrt(square) : across(shading_normal);
}

// The distribution of normals, 1/sr, of h's components along the grain (x), across it (y) and along the normal (z).
float d_ggx_anisotropic(vec3 h, float along, float across_it) {
    if (h.z <= 0.0) return 0.0;
    vec3 k = h / vec3(along, across_it, 1.0);
    float spread = dot(k, k);
    return 1.0 / (PI * along * across_it * spread * spread);
}

// D·V, 1/sr: Smith's masking with correlated heights (Heitz 2014, eq. 99) of the stretched lobe.
float grain_lobe(float roughness, float strength, vec3 grain, vec3 n, vec3 v, vec3 l) {
    float alpha = max(roughness * roughness, MIN_ALPHA);
    vec3 stretch = vec3(mix(alpha, 1.0, strength * strength), alpha, 1.0);
    mat3 local = mat3(grain, cross(n, grain), n);
    vec3 sum = v + l;
    vec3 h = sum * inversesqrt(max(dot(sum, sum), 1e-38)) * local;
    vec3 to_v = v * local;
    vec3 to_l = l * local;
    float n_dot_v = max(to_v.z, 1e-7);
    float n_dot_l = max(to_l.z, 1e-7);
    float toward_v = n_dot_l * length(stretch * vec3(to_v.xy, n_dot_v));
    float toward_l = n_dot_v * length(stretch * vec3(to_l.xy, n_dot_l));
    return d_ggx_anisotropic(h, stretch.x, stretch.y) * 0.5 / max(toward_v + toward_l, 1e-30);
}

// The normal at whose mirror direction an environment stands for the stretched lobe: bent from n towards the view's share
// in the plane of the grain and n, where the lobe's facets lie (McAuley 2015, "Rendering the World of Far Cry 4"), the
// more the stronger and the smoother (Khronos' glTF Sample Viewer). The view is above n, so that never nothing is left.
vec3 bent_normal(float roughness, float strength, vec3 grain, vec3 n, vec3 v) {
    if (strength <= 0.0) return n;
    vec3 bitangent = cross(n, grain);
    float kept = 1.0 - strength * (1.0 - roughness);
    kept *= kept;
    vec3 bent = mix(v - dot(bitangent, v) * bitangent, n, kept * kept);
    return bent * inversesqrt(dot(bent, bent));
}

// The roughness of a round lobe over about as large a solid angle, α_t·α_b.
float round_roughness(float roughness, float strength) {
    if (strength <= 0.0) return roughness; // a device's roots need not be exact
    float alpha = roughness * roughness;
    return sqrt(sqrt(alpha * mix(alpha, 1.0, strength * strength)));
}
