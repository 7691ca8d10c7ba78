// The views of a light's shadow maps, and where on them a surface point lies.
#include "cube_face.glsl"
#include "project.glsl"
uniform mat4 shadow_matrices[VIEWS];  // world to clip space
uniform float shadow_texels[VIEWS];   // metres per texel; times the distance for a light with a position
uniform vec4 shadow_light;            // position, w = 1; or the direction towards it, w = 0
uniform float bias;
uniform float slope_bias;
uniform float normal_offset;

// How far a point moves towards the light so that its own surface does not shadow it. One texel further along the
// map a plane's depth changes by texel·√(1 − (n·a)²)·|l·a|/(n·l), with `a` the map's axis; where the light is straight along
// the axis that is texel·tan θ. The filter's farthest corner lies `radius` texels away.
float bias_distance(float n_dot_l, float n_dot_a, float l_dot_a, float texel, float constant, float slope,
                    float radius) {
    float across = sqrt(max(1.0 - n_dot_a * n_dot_a, 0.0));
    return texel * (constant + slope * radius * across * abs(l_dot_a) / clamp(n_dot_l, 0.001, 1.0));
}

// How far a point moves along its normal: most where the light grazes it (Holbert 2011).
float normal_distance(float n_dot_l, float texel, float amount) {
    return texel * amount * sqrt(max(1.0 - n_dot_l * n_dot_l, 0.0));
}

// A point as its maps see it.
struct Receiver {
    vec3 position;   // moved by the biases
    vec3 coordinate; // on its view, 0…1, with its depth
    int view;
    bool inside;     // whether the view shows it and all that the filter reads around it
};

// From the light to a point; for a light without a position, along its rays.
vec3 from_light(vec3 point) {
    return shadow_light.w * point - shadow_light.xyz;
}

// The view that shows a point: of a cube the face, else there is one.
int view_of(vec3 point) {
#if VIEWS == 6
    return cube_face(from_light(point));
#else
    return 0;
#endif
}

// Where a surface is looked up; false where it faces away from the light.
//   reach: how far, in texels, the farthest corner of a texel that the filter compares may lie
//   margin: how near, in texels, the point may come to the view's edge
bool receive(vec3 position, vec3 normal, int view, float reach, float margin, out Receiver receiver) {
    vec3 offset = -from_light(position);
    float distance_to_light = length(offset);
    vec3 to_light = offset / distance_to_light;
    float n_dot_l = dot(normal, to_light);
    mat4 matrix = shadow_matrices[view];
    // A perspective view's last row is its axis.
    vec3 axis = shadow_light.w > 0.0 ? vec3(matrix[0].w, matrix[1].w, matrix[2].w) : to_light;
    float texel = shadow_texels[view] * (shadow_light.w > 0.0 ? distance_to_light : 1.0);
    float towards = bias_distance(n_dot_l, dot(normal, axis), dot(to_light, axis), texel, bias, slope_bias, reach);
    receiver.position = position + to_light * towards + normal * normal_distance(n_dot_l, texel, normal_offset);
    receiver.view = view;
    bool before = project(matrix, receiver.position, receiver.coordinate);
    // Outside of the map, and behind a spot, nothing stands in the light's way (nor does any light arrive).
    float edge = margin / float(RESOLUTION);
    receiver.inside = before && all(greaterThanEqual(receiver.coordinate.xy, vec2(edge))) &&
                      all(lessThan(receiver.coordinate, vec3(vec2(1.0 - edge), 1.0)));
    return n_dot_l > 0.0;
}
