// Which share of a hemisphere's places lies before what the screen shows there (de Vries 2015, Learn OpenGL: SSAO).
#include "project.glsl"
#include "shown.glsl"
uniform mat4 view_projection;
uniform vec3 camera_right;
uniform vec3 camera_up;
uniform vec3 camera_back;
uniform vec3 kernel[SAMPLES];
uniform vec2 rotations[16];
uniform float radius;
uniform float bias;
uniform float power;

// A place around +z in the frame of a normal whose first axis is the nearest to `along`.
vec3 around_normal(vec3 place, vec3 along, vec3 normal) {
    vec3 tangent = along - normal * dot(along, normal);
    tangent *= inversesqrt(max(dot(tangent, tangent), 1e-12));
    return place.x * tangent + place.y * cross(normal, tangent) + place.z * normal;
}

// How much an occluder so far in depth from the point counts: all within the radius, beyond it less and less.
float range_check(float depth_difference, float reach) {
    float x = clamp(reach / max(abs(depth_difference), 1e-9), 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
}

vec4 occlusion(Surface surface, ivec2 pixel) {
    ivec2 cell = (pixel / SCALE) & 3;
    vec2 turn = rotations[4 * cell.y + cell.x];
    vec3 along = turn.x * camera_right + turn.y * camera_up;
    float hidden = 0.0;
    for (int i = 0; i < SAMPLES; ++i) {
        vec3 offset = radius * around_normal(kernel[i], along, surface.normal);
        vec3 where;
        if (!project(view_projection, surface.position + offset, where)) continue;
        vec3 shown;
        if (!shown_at(ivec2(floor(where.xy * vec2(screen_size))), shown)) continue;
        float nearer = dot(shown - surface.position, camera_back); // to the viewer than the point
        bool before = nearer >= dot(offset, camera_back) + bias;
        hidden += before ? range_check(nearer, radius) : 0.0;
    }
    return vec4(surface.normal, pow(1.0 - hidden / float(SAMPLES), power));
}
