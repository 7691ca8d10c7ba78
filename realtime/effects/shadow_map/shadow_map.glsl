// Which share of a light reaches a point, by comparing depths (Williams 1978; Reeves et al. 1987).
uniform sampler2D shadow_map;         // one view, or a cube's six faces as 3 × 2 tiles
uniform mat4 shadow_matrices[VIEWS];  // world to clip space
uniform vec4 shadow_light;            // position, w = 1; or the direction towards it, w = 0
uniform float shadow_texel;           // metres per texel; times the distance for w = 1
uniform float bias;
uniform float slope_bias;

// The face of a cube that a direction leaves through: +x −x +y −y +z −z.
int cube_face(vec3 d) {
    vec3 a = abs(d);
    if (a.x >= a.y && a.x >= a.z) return d.x >= 0.0 ? 0 : 1;
    if (a.y >= a.z) return d.y >= 0.0 ? 2 : 3;
    return d.z >= 0.0 ? 4 : 5;
}

// How far a point moves towards the light so that its own surface does not shadow it. One texel further along the
// map a plane's depth changes by texel·√(1 − (n·a)²)·|l·a|/(n·l), with `a` the map's axis; where the light is straight along
// the axis that is texel·tan θ. The filter's farthest corner lies `radius` texels away.
float bias_distance(float n_dot_l, float n_dot_a, float l_dot_a, float texel, float constant, float slope,
                    float radius) {
    float across = sqrt(max(1.0 - n_dot_a * n_dot_a, 0.0));
    return texel * (constant + slope * radius * across * abs(l_dot_a) / clamp(n_dot_l, 0.05, 1.0));
}

// Window coordinates 0…1 of a point in one view; false behind the light.
bool project(mat4 view, vec3 point, out vec3 coordinate) {
    vec4 clip = view * vec4(point, 1.0);
    coordinate = clip.xyz / clip.w * 0.5 + 0.5;
    return clip.w > 0.0;
}

// The share of neighbouring texels that are not nearer to the light. Views have a border as wide as the filter, so that
// no neighbour of a point within is outside.
float filtered(vec3 coordinate, int face) {
    ivec2 centre = ivec2(coordinate.xy * float(RESOLUTION)) + RESOLUTION * ivec2(face % 3, face / 3);
    float sum = 0.0;
    for (int y = -FILTER_RADIUS; y <= FILTER_RADIUS; ++y)
        for (int x = -FILTER_RADIUS; x <= FILTER_RADIUS; ++x)
            sum += coordinate.z <= texelFetch(shadow_map, centre + ivec2(x, y), 0).r ? 1.0 : 0.0;
    return sum / float((2 * FILTER_RADIUS + 1) * (2 * FILTER_RADIUS + 1));
}

vec3 visibility(Surface surface) {
    vec3 offset = shadow_light.xyz - shadow_light.w * surface.position;
    float distance_to_light = length(offset);
    vec3 to_light = offset / distance_to_light;
    float n_dot_l = dot(surface.normal, to_light);
    if (n_dot_l <= 0.0) return vec3(0.0);
#if VIEWS == 6
    int face = cube_face(-offset);
#else
    int face = 0;
#endif
    mat4 view = shadow_matrices[face];
    // A perspective view's last row is its axis.
    vec3 axis = shadow_light.w > 0.0 ? vec3(view[0].w, view[1].w, view[2].w) : to_light;
    float texel = shadow_texel * (shadow_light.w > 0.0 ? distance_to_light : 1.0);
    float radius = (float(FILTER_RADIUS) + 0.5) * 1.41421356;
    vec3 point = surface.position + to_light * bias_distance(n_dot_l, dot(surface.normal, axis), dot(to_light, axis),
                                                            texel, bias, slope_bias, radius);
    vec3 coordinate;
    bool before = project(view, point, coordinate);
    // Outside of the map, and behind a spot, nothing stands in the light's way (nor does any light arrive).
    float margin = float(FILTER_RADIUS) / float(RESOLUTION);
    bool inside = all(greaterThanEqual(coordinate.xy, vec2(margin))) &&
                  all(lessThan(coordinate, vec3(vec2(1.0 - margin), 1.0)));
    return vec3(before && inside ? filtered(coordinate, face) : 1.0);
}
