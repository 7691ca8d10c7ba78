// The picture in each flat mirror; the surfaces that are none get constant ambient light.
#define SAMPLES 1
#include "reflections.glsl"
uniform sampler2D mirror_images[MIRRORS]; // as the frame, with left and right exchanged
uniform vec4 mirror_planes[MIRRORS];      // unit normal, minus the distance from the origin
uniform vec2 image_size;
uniform float tolerance; // metres

// Whether a point with its normal lies on a plane's front.
bool lies_on(vec4 plane, vec3 point, vec3 normal, float near) {
    return abs(dot(plane.xyz, point) + plane.w) <= near && dot(plane.xyz, normal) > 0.999;
}

vec3 seen_along(Surface surface, vec3 direction) {
    vec2 place = gl_FragCoord.xy / image_size;
    for (int i = 0; i < MIRRORS; ++i)
        if (lies_on(mirror_planes[i], surface.position, surface.normal, tolerance))
            return textureLod(mirror_images[i], vec2(1.0 - place.x, place.y), 0.0).rgb;
    return ambient_radiance;
}

vec3 indirect(Surface surface) {
    return reflected(surface);
}
