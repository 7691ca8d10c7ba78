// Radiance reflected from a rectangle, disk or sphere of even radiance, as if all of it came from one point: for the
// lobe the point nearest to the reflection ray, the lobe's peak lowered as the light's size widens it (Karis 2013).
#include "lobes.glsl"
uniform vec3 light_centre;
uniform vec3 light_radiance;
uniform vec3 light_axes[3]; // along the sides or across the disk, and the normal; a sphere has none
uniform vec2 light_extent;  // half sides; or the radius, twice
uniform vec2 light_radii;   // of the ellipse with the same area
uniform bool is_sphere;
uniform bool is_round;      // disk or sphere
uniform bool two_sided;
uniform bool five_points;
uniform float widening;

// From the receiver to the point of a sphere that is nearest to the ray (Karis 2013, eq. 11, 12).
vec3 nearest_on_sphere(vec3 to_centre, float radius, vec3 ray) {
    vec3 across = max(dot(to_centre, ray), 0.0) * ray - to_centre;
    return to_centre + across * min(1.0, radius * inversesqrt(max(dot(across, across), 1e-30)));
}

// Where the ray meets the light's plane, from the light's centre along its axes. A ray that leaves the plane meets it
// nearly infinitely far away on the side that it leans to.
vec2 meets_plane(vec3 to_centre, vec3 u, vec3 v, vec3 normal, vec3 ray) {
    float distance_along = -dot(to_centre, normal) / max(-dot(ray, normal), 1e-4);
    vec3 offset = distance_along * ray - to_centre;
    return vec2(dot(offset, u), dot(offset, v));
}

vec2 held_within(vec2 place, vec2 extent, bool disk) {
    if (!disk) return clamp(place, -extent, extent);
    return place * min(1.0, extent.x * inversesqrt(max(dot(place, place), 1e-30)));
}

// Solid angle of a disk seen at an angle from `square_ratio` = (radius / distance)²: exact along its axis and far away.
float solid_angle_of_disk(float square_ratio, float cos_light) {
    float s = sqrt(1.0 + square_ratio);
    return 2.0 * PI * cos_light * square_ratio / (s * (1.0 + s));
}

// By how much the lobe's peak is lowered: (α/α')² with α' = α + widening·radius/distance (Karis 2013, eq. 10, 14), an
// α' for each axis.
float lowered_peak(float alpha, vec2 angles, float width) {
    vec2 widened = min(alpha + width * angles, vec2(1.0));
    return alpha * alpha / (widened.x * widened.y);
}

float clamped_cosine(vec3 n, vec3 offset) {
    return max(dot(n, offset), 0.0) * inversesqrt(max(dot(offset, offset), 1e-30));
}

// Mean of max(n·l, 0) over the light's centre and its corners, or four points of its rim (Lagarde & de Rousiers 2014,
// "Moving Frostbite to Physically Based Rendering", section 4.8.2).
float mean_of_five(vec3 n, vec3 to_centre, vec3 u, vec3 v, bool disk) {
    vec3 a = disk ? u : u + v;
    vec3 b = disk ? v : u - v;
    return 0.2 * (clamped_cosine(n, to_centre) + clamped_cosine(n, to_centre + a) + clamped_cosine(n, to_centre - a) +
                  clamped_cosine(n, to_centre + b) + clamped_cosine(n, to_centre - b));
}

vec3 direct(Surface surface) {
    vec3 to_centre = light_centre - surface.position;
    float square = dot(to_centre, to_centre);
    vec3 centre_direction = to_centre * inversesqrt(max(square, 1e-30));
    float radius_square = light_radii.x * light_radii.y;
    // A sphere is seen as the disk that its outline bounds, which faces the receiver; from within it is dark.
    float disk_square = is_sphere ? square - radius_square : square;
    vec3 normal = is_sphere ? -centre_direction : light_axes[2];
    float cos_light = -dot(centre_direction, normal);
    if (two_sided && cos_light < 0.0) {
        normal = -normal;
        cos_light = -cos_light;
    }
    if (disk_square <= 0.0 || cos_light <= 0.0) return vec3(0.0);

    vec3 ray = reflect(-surface.view, surface.normal);
    vec3 nearest;
    vec3 u = light_axes[0] * light_extent.x;
    vec3 v = light_axes[1] * light_extent.y;
    if (is_sphere) {
        nearest = nearest_on_sphere(to_centre, light_extent.x, ray);
        vec3 helper = abs(centre_direction.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
        float outline = light_extent.x * sqrt(square / disk_square);
        u = outline * normalize(cross(helper, centre_direction));
        v = cross(centre_direction, u);
    } else {
        vec2 place = meets_plane(to_centre, light_axes[0], light_axes[1], normal, ray);
        place = held_within(place, light_extent, is_round);
        nearest = to_centre + place.x * light_axes[0] + place.y * light_axes[1];
    }
    vec3 to_nearest = nearest * inversesqrt(max(dot(nearest, nearest), 1e-30));
    float solid_angle = solid_angle_of_disk(radius_square / disk_square, cos_light);
    float alpha = max(surface.roughness * surface.roughness, MIN_ALPHA);
    float peak = lowered_peak(alpha, light_radii * inversesqrt(square), widening);
    float cos_surface = five_points ? mean_of_five(surface.normal, to_centre, u, v, is_round)
                                    : clamped_cosine(surface.normal, to_centre);
    vec3 mirrored = specular_lobe(surface.base_color, surface.metallic, surface.roughness, surface.specular,
                                  surface.normal, surface.view, to_nearest) * peak;
    vec3 scattered = diffuse_lobe(surface.base_color, surface.metallic, surface.specular, surface.view,
                                  centre_direction) * cos_surface;
    return light_radiance * solid_angle * (mirrored + scattered);
}
