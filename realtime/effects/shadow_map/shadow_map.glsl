// Which share of a light reaches a point, by comparing depths (Williams 1978).
#include "shadow_views.glsl"
#include "shadow_filter.glsl"

vec3 visibility(Surface surface) {
    Receiver receiver;
    int view = view_of(surface.position);
    if (!receive(surface.position, surface.normal, view, FILTER_REACH, FILTER_MARGIN, receiver)) return vec3(0.0);
    return vec3(receiver.inside ? filtered(receiver.coordinate, view) : 1.0);
}
