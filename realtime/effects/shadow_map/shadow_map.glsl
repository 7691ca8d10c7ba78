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

// Window coordinates 0…1 of a point in one view; false behind the light.
bool project(mat4 view, vec3 point, out vec3 coordinate) {
    vec4 clip = view * vec4(point, 1.0);
    coordinate = clip.xyz / clip.w * 0.5 + 0.5;
    return clip.w > 0.0;
}

// The comparison with one texel; outside of the map nothing stands in the light's way.
float compared(ivec2 texel, int face, float depth) {
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(RESOLUTION))) || depth > 1.0) return 1.0;
    return depth <= texelFetch(shadow_map, texel + RESOLUTION * ivec2(face % 3, face / 3), 0).r ? 1.0 : 0.0;
}

#if VIEWS == 6
// On a cube every neighbour finds its own face, so that the faces' edges have no seams.
float filtered(vec3 point, vec3 to_light, float texel) {
    vec3 across = abs(to_light.x) < 0.6 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    vec3 right = normalize(cross(across, to_light)) * texel;
    vec3 up = cross(to_light, right);
    float sum = 0.0;
    for (int y = -FILTER_RADIUS; y <= FILTER_RADIUS; ++y)
        for (int x = -FILTER_RADIUS; x <= FILTER_RADIUS; ++x) {
            vec3 neighbour = point + float(x) * right + float(y) * up;
            int face = cube_face(neighbour - shadow_light.xyz);
            vec3 coordinate;
            project(shadow_matrices[face], neighbour, coordinate);
            ivec2 place = ivec2(clamp(coordinate.xy * float(RESOLUTION), 0.0, float(RESOLUTION - 1)));
            sum += compared(place, face, coordinate.z);
        }
    return sum;
}
#else
float filtered(vec3 point, vec3 to_light, float texel) {
    vec3 coordinate;
    if (!project(shadow_matrices[0], point, coordinate)) return float((2 * FILTER_RADIUS + 1) * (2 * FILTER_RADIUS + 1));
    ivec2 centre = ivec2(floor(coordinate.xy * float(RESOLUTION)));
    float sum = 0.0;
    for (int y = -FILTER_RADIUS; y <= FILTER_RADIUS; ++y)
        for (int x = -FILTER_RADIUS; x <= FILTER_RADIUS; ++x) sum += compared(centre + ivec2(x, y), 0, coordinate.z);
    return sum;
}
#endif

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
    return vec3(filtered(point, to_light, texel) / float((2 * FILTER_RADIUS + 1) * (2 * FILTER_RADIUS + 1)));
}
