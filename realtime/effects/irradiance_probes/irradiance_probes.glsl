// Irradiance of the eight probes around a point, on the diffuse base.
#include "brdf.glsl"
uniform sampler2D probes; // a column for each probe; rows: +x −x +y −y +z −z; w: 0 where it is left out
uniform vec3 grid_low;
uniform vec3 grid_step;
uniform ivec3 grid_counts;

// The share that trilinear interpolation gives to a corner of the cell (its coordinates 0 or 1).
float corner_weight(vec3 share, vec3 corner) {
    vec3 each = mix(1.0 - share, share, corner);
    return each.x * each.y * each.z;
}

// How much a probe counts that lies in some direction: less behind the surface (Majercik et al. 2019, listing 1; the
// rest that it keeps is theirs).
float facing_weight(vec3 normal, vec3 to_probe) {
    float wrapped = 0.5 + 0.5 * dot(normal, to_probe) * inversesqrt(max(dot(to_probe, to_probe), 1e-20));
    return wrapped * wrapped + 0.2;
}

// Irradiance over π on a normal, from six axes: the squares of its components add up to 1 (McTaggart 2004).
vec4 from_probe(int probe, vec3 normal) {
    vec3 square = normal * normal;
    return square.x * texelFetch(probes, ivec2(probe, normal.x >= 0.0 ? 0 : 1), 0) +
           square.y * texelFetch(probes, ivec2(probe, normal.y >= 0.0 ? 2 : 3), 0) +
           square.z * texelFetch(probes, ivec2(probe, normal.z >= 0.0 ? 4 : 5), 0);
}

vec3 indirect(Surface surface) {
    vec3 place = clamp((surface.position - grid_low) / grid_step, vec3(0.0), vec3(grid_counts - 1));
    ivec3 first = min(ivec3(place), max(grid_counts - 2, ivec3(0)));
    vec3 sum = vec3(0.0);
    float total = 0.0;
    for (int i = 0; i < 8; ++i) {
        ivec3 corner = ivec3(i & 1, i >> 1 & 1, i >> 2);
        ivec3 at = min(first + corner, grid_counts - 1);
        vec4 found = from_probe(at.x + grid_counts.x * (at.y + grid_counts.y * at.z), surface.normal);
        float weight = corner_weight(place - vec3(first), vec3(corner)) * (found.w > 0.5 ? 1.0 : 0.0);
#ifdef FACING
        weight *= facing_weight(surface.normal, grid_low + grid_step * vec3(at) - surface.position);
#endif
        sum += weight * found.rgb;
        total += weight;
    }
    return sum / max(total, 1e-6) * diffuse_color(surface.base_color, surface.metallic);
}
