// Radiance reflected from convex emissive polygons of even radiance: the specular lobe as a linearly transformed cosine (Heitz,
// Dupuy, Hill & Neubelt 2016), the diffuse one by Lambert's formula, both above the horizon alone.
#include "lobes.glsl"
#include "polygon_irradiance.glsl"
uniform vec3 light_centre;
uniform vec3 light_radiance;
uniform vec4 light_corners[MOST_CORNERS]; // xyz: from the centre; w = 1: the last one of its polygon
uniform int corner_count;
uniform float sphere_radius; // above 0: a sphere; its outline's corners are on a unit circle in the plane across
uniform bool two_sided;
uniform sampler2D cosine_table; // entries 00, 02, 20, 22 over 11 of what is left of M⁻¹ beside the narrow lobe's
uniform sampler2D albedo_table; // albedo, and the part of it that goes with (1 − v·h)⁵, over the cosine's share above

// A convex polygon on its way through a half space z > 0, side by side (Sutherland & Hodgman 1974). It leaves the half
// space at most once, and comes back at most once: the side between these two places, along the horizon, closes it.
struct Cut {
    vec3 left;
    vec3 entered;
    bool crosses;
};

// The part of the side from a to b above the horizon, in place; false where there is none.
bool cut_side(inout Cut cut, float base_height, inout vec3 a, inout vec3 b) {
    float height_a = base_height + a.z;
    float height_b = base_height + b.z;
    bool above_a = height_a > 0.0;
    bool above_b = height_b > 0.0;
    vec3 crossing = on_horizon(a, b, height_a, height_b);
    if (above_a && !above_b) b = cut.left = crossing;
    if (above_b && !above_a) a = cut.entered = crossing;
    cut.crosses = cut.crosses || above_a != above_b;
    return above_a || above_b;
}

struct Sums {
    vec3 diffuse; // irradiance vector, times 2
    float lobe;   // its vertical part in the cosine's space
    Cut cut;      // in the cosine's space
};

// Adds a side that lies above the surface's horizon.
void add_side(inout Sums sums, mat3 to_cosine, vec3 base, vec3 cosine_base, vec3 a, vec3 b) {
    sums.diffuse += side_irradiance(base, a, b);
    vec3 c = to_cosine * a;
    vec3 d = to_cosine * b;
    if (cut_side(sums.cut, cosine_base.z, c, d)) sums.lobe += side_irradiance(cosine_base, c, d).z;
}

const Cut UNCUT = Cut(vec3(0.0), vec3(0.0), false);

vec3 direct(Surface surface) {
    vec3 n = surface.normal;
    float n_dot_v = clamp(dot(n, surface.view), 0.0, 1.0);
    vec3 across = surface.view - n_dot_v * n;
    float n_sin_v = length(across);
    // Straight from above any direction will do.
    vec3 helper = abs(n.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    across = n_sin_v > 1e-5 ? across : helper - dot(helper, n) * n;
    vec3 t = normalize(across);
    mat3 to_local = transpose(mat3(t, cross(n, t), n));

    vec2 place = vec2(sqrt(1.0 - n_dot_v), surface.roughness) * (1.0 - 1.0 / float(TABLE_SIDE)) + 0.5 / float(TABLE_SIDE);
    vec4 m = texture(cosine_table, place);
    vec2 albedo = texture(albedo_table, place).xy;
    // A narrow lobe nearly is a cosine once the mirror direction has become z and its widths 1, up to a factor (fit.py).
    float alpha = max(surface.roughness * surface.roughness, MIN_ALPHA);
    float width = inversesqrt(n_dot_v * n_dot_v + alpha * alpha * n_sin_v * n_sin_v);
    mat3 from_narrow = mat3(n_dot_v, 0.0, -alpha * n_sin_v, 0.0, width, 0.0, n_sin_v, 0.0, alpha * n_dot_v);
    mat3 to_cosine = mat3(m.x, 0.0, m.z, 0.0, 1.0, 0.0, m.y, 0.0, m.w) * from_narrow;

    vec3 to_centre = light_centre - surface.position;
    vec3 base = to_local * to_centre;
    mat3 offsets = to_local;
    if (sphere_radius > 0.0) {
        // The outline of a sphere is a circle on the cone around it, in the plane through its centre.
        float square = dot(to_centre, to_centre);
        float outside = square - sphere_radius * sphere_radius;
        if (outside <= 0.0) return vec3(0.0);
        vec3 towards = base * inversesqrt(square);
        vec3 helper = abs(towards.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
        vec3 u = normalize(cross(helper, towards));
        // Seen from the sphere's side the corners run anticlockwise.
        offsets = sphere_radius * sqrt(square / outside) * mat3(u, cross(u, towards), vec3(0.0));
    }

    vec3 diffuse = vec3(0.0);
    float lobe = 0.0;
    vec3 cosine_base = to_cosine * base;
    int corner = 0;
    while (corner < corner_count) {
        Sums sums = Sums(vec3(0.0), 0.0, UNCUT);
        Cut cut = UNCUT;
        vec3 first = offsets * light_corners[corner].xyz;
        vec3 here = first;
        bool is_last;
        do {
            is_last = light_corners[corner].w > 0.0;
            vec3 next = is_last ? first : offsets * light_corners[is_last ? corner : corner + 1].xyz;
            vec3 a = here;
            vec3 b = next;
            if (cut_side(cut, base.z, a, b)) add_side(sums, to_cosine, base, cosine_base, a, b);
            here = next;
            ++corner;
        } while (!is_last);
        if (cut.crosses) add_side(sums, to_cosine, base, cosine_base, cut.left, cut.entered);
        if (sums.cut.crosses) sums.lobe += side_irradiance(cosine_base, sums.cut.left, sums.cut.entered).z;
        // Seen from behind, every side runs the other way round.
        float front = sums.diffuse.z > 0.0 ? 1.0 : two_sided ? -1.0 : 0.0;
        diffuse += front * sums.diffuse;
        lobe += max(front * sums.lobe, 0.0);
    }
    // Fresnel dims the base as for light from the middle of what is seen.
    vec3 middle = diffuse * inversesqrt(max(dot(diffuse, diffuse), 1e-30));
    vec3 f0 = reflectance_f0(surface.base_color, surface.metallic, surface.specular);
    vec3 f90 = reflectance_f90(surface.metallic, surface.specular);
    vec3 mirrored = (f0 * (albedo.x - albedo.y) + f90 * albedo.y) * (lobe * (0.5 / PI));
    vec3 scattered = diffuse_lobe(surface.base_color, surface.metallic, surface.specular, to_local * surface.view, middle) *
                     (diffuse.z * 0.5);
    return light_radiance * (mirrored + scattered);
}
