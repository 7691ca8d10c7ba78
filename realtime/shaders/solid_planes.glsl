// Solids from within: the tangent plane where a direction from the middle leaves them.
#include "cube_face.glsl"
uniform sampler2D solid_planes[SOLIDS];
uniform mat4 solid_views[6 * SOLIDS]; // world to clip space
uniform vec3 solid_middle[SOLIDS];
uniform vec3 solid_low[SOLIDS];
uniform vec3 solid_high[SOLIDS];

// RGB the normal, out of the solid; A the plane's distance from the middle.
vec4 plane_along(int solid, vec3 direction) {
    int face = cube_face(direction);
    vec4 clip = solid_views[6 * solid + face] * vec4(solid_middle[solid] + direction, 1.0);
    vec2 size = vec2(textureSize(solid_planes[solid], 0)) / vec2(3.0, 2.0);
    // Half a texel within: what lies across an edge of a face is another one's.
    vec2 place = clamp(clip.xy / clip.w * 0.5 + 0.5, 0.5 / size, 1.0 - 0.5 / size);
    return textureLod(solid_planes[solid], (place + vec2(face % 3, face / 3)) / vec2(3.0, 2.0), 0.0);
}

// How far it is along a ray to a plane that it leaves through; `start` from the solid's middle.
float distance_to_plane(vec3 start, vec3 direction, vec4 plane) {
    return max(plane.w - dot(plane.xyz, start), 0.0) / max(dot(plane.xyz, direction), 1e-4);
}

// The plane through which a ray leaves a convex solid, and how far that is: the tangent plane where the last guess lies
// from the middle gives the next one, as Newton's method does.
vec4 exit_plane(int solid, vec3 start, vec3 direction, out float way) {
    float reach = length(solid_high[solid] - solid_low[solid]);
    way = 0.5 * reach;
    vec4 plane;
    for (int i = 0; i < ITERATIONS; ++i) {
        plane = plane_along(solid, start + way * direction);
        way = min(distance_to_plane(start, direction, plane), reach);
    }
    return plane;
}
