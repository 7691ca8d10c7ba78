// Which share of a sun's light reaches a point, from several maps, each fitted to a slice of the camera's field
// (Engel 2006; Zhang et al. 2006, parallel-split shadow maps).
#include "shadow_views.glsl"
#include "shadow_filter.glsl"
uniform vec4 cascade_depth; // a point's distance along the camera's axis
uniform vec4 cascade_ends;  // how far each cascade reaches

// The first cascade that reaches as far as a depth.
int cascade_of(float depth, vec4 ends) {
    bvec4 beyond = greaterThan(vec4(depth), ends);
    return int(beyond.x) + int(beyond.y) + int(beyond.z) + int(beyond.w);
}

vec3 visibility(Surface surface) {
    Receiver receiver;
    int view = cascade_of(dot(cascade_depth, vec4(surface.position, 1.0)), cascade_ends);
    if (!receive(surface.position, surface.normal, view, FILTER_REACH, FILTER_MARGIN, receiver)) return vec3(0.0);
    return vec3(receiver.inside ? filtered(receiver.coordinate, view) : 1.0);
}
