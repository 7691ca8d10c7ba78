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

// How far a point moves towards the light: a texel seen at a slope spans texel·tan θ of depth, and a filter of the
// given radius (in texels) reaches that much further.
float bias_distance(float n_dot_l, float texel, float constant, float slope, float radius) {
    float cosine = clamp(n_dot_l, 0.05, 1.0);
    float tangent = sqrt(1.0 - cosine * cosine) / cosine;
    return texel * (constant + slope * radius * tangent);
}

float reached(vec3 point) {
#if VIEWS == 6
    int face = cube_face(point - shadow_light.xyz);
#else
    const int face = 0;
#endif
    vec4 clip = shadow_matrices[face] * vec4(point, 1.0);
    vec3 coordinate = clip.xyz / clip.w * 0.5 + 0.5;
    if (clip.w <= 0.0 || any(lessThan(coordinate, vec3(0.0))) || coordinate.z > 1.0) return 1.0;
    ivec2 texel = ivec2(min(coordinate.xy * float(RESOLUTION), vec2(RESOLUTION - 1)));
    if (VIEWS == 1 && any(greaterThan(coordinate.xy, vec2(1.0)))) return 1.0;
    texel += RESOLUTION * ivec2(face % 3, face / 3);
    return coordinate.z <= texelFetch(shadow_map, texel, 0).r ? 1.0 : 0.0;
}

vec3 visibility(Surface surface) {
    vec3 offset = shadow_light.xyz - shadow_light.w * surface.position;
    float distance_to_light = length(offset);
    vec3 to_light = offset / distance_to_light;
    float texel = shadow_texel * (shadow_light.w > 0.0 ? distance_to_light : 1.0);
    float n_dot_l = dot(surface.normal, to_light);
    if (n_dot_l <= 0.0) return vec3(0.0);
    // The farthest corner that is compared lies (radius + ½)·√2 texels away.
    float radius = (float(FILTER_RADIUS) + 0.5) * 1.41421356;
    vec3 point = surface.position + to_light * bias_distance(n_dot_l, texel, bias, slope_bias, radius);
#if FILTER_RADIUS == 0
    return vec3(reached(point));
#else
    // Neighbours across the light's direction; on a cube each finds its own face, so that edges have no seams.
    vec3 across = abs(to_light.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    vec3 right = normalize(cross(across, to_light)) * texel;
    vec3 up = cross(to_light, right);
    float sum = 0.0;
    for (int y = -FILTER_RADIUS; y <= FILTER_RADIUS; ++y)
        for (int x = -FILTER_RADIUS; x <= FILTER_RADIUS; ++x)
            sum += reached(point + float(x) * right + float(y) * up);
    return vec3(sum / float((2 * FILTER_RADIUS + 1) * (2 * FILTER_RADIUS + 1)));
#endif
}
