// Ambient visibility from horizons (Jimenez et al. 2016, "Practical Realtime Strategies for Accurate Indirect Occlusion").
// A slice is the half disk above a line on the screen, through the direction to the viewer; angles in it count from there,
// positive towards the line's end. All that lies below a horizon counts as hidden.
#include "shown.glsl"
uniform vec3 camera_right;
uniform vec3 camera_up;
uniform vec3 camera_back;
uniform float pixels_per_metre; // a metre away from the viewer; for parallel rays anywhere
uniform float radius;
uniform float falloff;
uniform float thickness;
const float HALF_TURN = 3.14159265358979;

// The cosine-weighted visible share of a slice from the viewer's direction to a horizon `h`, with the projected normal at
// the angle `n` (eq. 7).
float slice_visibility(float h, float n) {
    return 0.25 * (cos(n) - cos(2.0 * h - n) + 2.0 * h * sin(n));
}

// The mean of its directions with the same weight: towards the line's end, and towards the viewer.
vec2 slice_mean(float h, float n) {
    float across = 6.0 * sin(h - n) - sin(3.0 * h - n) - 3.0 * sin(h + n) + 8.0 * sin(n);
    float along = 4.0 * cos(n) - cos(3.0 * h - n) - 3.0 * cos(h + n);
    return vec2(across, along) / 12.0;
}

// How much an occluder counts at a distance: all, and over the last part of the radius less and less.
float counted(float distance_to, float reach, float fading) {
    return clamp((reach - distance_to) / max(reach * fading, 1e-6), 0.0, 1.0);
}

// The cosine of the horizon after another place is seen: up to it, or back by a part (section 4, thickness heuristic).
float raised(float horizon, float seen, float falls_back) {
    return seen > horizon ? seen : mix(horizon, seen, falls_back);
}

// Where in a pattern of 4 × 4 pixels slices are turned (x), and where in a step places lie (y), 0…1 (section 4, noise).
vec2 pattern(int column, int row) {
    int turn = (((column + row) & 3) << 2) + (column & 3);
    return vec2(float(turn) / 16.0, float((row - column) & 3) / 4.0 + 0.125);
}

// What a pixel's centre shows lies beside the slice: moved into it along the surface's own plane. Without that a slanted
// plane hides itself, as some of its places beside the slice lie higher than those in it.
vec3 into_slice(vec3 offset, vec3 across, vec3 normal) {
    vec3 along_plane = across - normal * dot(across, normal);
    return offset - along_plane * (dot(offset, across) / max(dot(along_plane, along_plane), 1e-6));
}

// The cosine of the horizon on one side of a slice, whose plane is normal to `across`.
float horizon_towards(vec2 line, vec3 across, float reach, float shift, ivec2 pixel, Surface surface, float lowest) {
    float horizon = lowest, pixels = length(line);
    for (int i = 0; i < STEPS; ++i) {
        float part = (float(i) + shift) / float(STEPS);
        ivec2 there = ivec2(floor(vec2(pixel) + 0.5 + max(part * part * reach, 1.0 / pixels) * line));
        vec3 shown;
        if (!shown_at(there, shown)) continue;
        vec3 offset = into_slice(shown - surface.position, across, surface.normal);
        float away = length(offset);
        if (away == 0.0) continue;
        float seen = mix(lowest, dot(offset, surface.view) / away, counted(away, radius, falloff));
        horizon = raised(horizon, seen, thickness);
    }
    return horizon;
}

vec4 occlusion(Surface surface, ivec2 pixel) {
    vec2 shift = pattern(pixel.x / SCALE, pixel.y / SCALE);
    float depth = dot(viewer.xyz - surface.position, camera_back);
    float reach = radius * pixels_per_metre / (viewer.w > 0.0 ? max(depth, 1e-6) : 1.0);
    vec3 from = surface.position - viewer.xyz;
    vec2 slope = viewer.w > 0.0 ? vec2(dot(from, camera_right), dot(from, camera_up)) / max(depth, 1e-6) : vec2(0.0);
    vec3 first = normalize(camera_right - surface.view * dot(camera_right, surface.view));
    vec3 second = cross(surface.view, first);
    float visible = 0.0;
    vec3 mean = vec3(0.0);
    for (int i = 0; i < SLICES; ++i) {
        float turn = HALF_TURN * (float(i) + shift.x) / float(SLICES);
        // Even around the direction to the viewer, which on the screen is uneven away from its middle.
        vec3 end = cos(turn) * first + sin(turn) * second;
        vec2 line = vec2(dot(end, camera_right), dot(end, camera_up)) + slope * dot(end, camera_back);
        vec3 across = cross(end, surface.view);
        vec3 projected = surface.normal - across * dot(surface.normal, across);
        float size = length(projected);
        float n = atan(dot(projected, end), dot(projected, surface.view));
        // On each side the lowest horizon is the plane through the point.
        float before = acos(clamp(horizon_towards(line, across, reach, shift.y, pixel, surface, -sin(n)), -1.0, 1.0));
        float behind = -acos(clamp(horizon_towards(-line, across, reach, shift.y, pixel, surface, sin(n)), -1.0, 1.0));
        before = min(before, n + 0.5 * HALF_TURN);
        behind = max(behind, n - 0.5 * HALF_TURN);
        visible += size * (slice_visibility(before, n) + slice_visibility(behind, n));
        vec2 part = slice_mean(before, n) + slice_mean(behind, n);
        mean += size * (part.x * end + part.y * surface.view);
    }
    // Of few slices it may exceed 1; limited before it is averaged over pixels, a plane would darken.
    return vec4(mean, visible / float(SLICES));
}
