#include "solid_front.glsl"
#include "project.glsl"
uniform sampler2D back_normal;
uniform sampler2D back_position;
uniform mat4 back_view;

// Leaving a solid: Snell's law, or along its surface from the critical angle on. `outward` is the back's normal.
vec3 leaving(vec3 outward, vec3 inside, float ior) {
    float cosine = clamp(dot(outward, inside), 0.0, 1.0);
    return normalize(refracted(-outward, -inside, cosine, 1.0 / ior));
}

vec3 transmission(Surface surface) {
    if (surface.ior <= 0.0) return vec3(0.0);
    float mirrored;
    vec3 inside = entering(surface, mirrored);
    ivec2 size = textureSize(back_normal, 0);
    vec3 straight = texelFetch(back_position, ivec2(gl_FragCoord.xy), 0).xyz;
    float thickness = length(straight - surface.position);
    vec3 coordinate;
    project(back_view, surface.position + thickness * inside, coordinate);
    ivec2 place = clamp(ivec2(coordinate.xy * vec2(size)), ivec2(0), size - 1);
    vec4 back = texelFetch(back_normal, place, 0);
    // Beside the solid there is no back: the ray leaves across the view.
    vec3 outward = back.w > 0.0 ? back.xyz : normalize(inside + surface.view * max(-dot(inside, surface.view), 0.0));
    float travelled = back.w > 0.0 ? length(texelFetch(back_position, place, 0).xyz - surface.position) : thickness;
    vec3 left = exp(-surface.absorption * travelled);
    vec3 through = left * seen_around(leaving(outward, inside, surface.ior));
    return behind_front(surface, through, mirrored);
}
