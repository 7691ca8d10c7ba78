// Which share of an emissive surface reaches a point, from one depth map seen from its centre (Fernando 2005): blockers
// are looked for, their mean distance says how wide the penumbra is there, and comparisons are averaged over that width.
//
// The filter is laid out in the world, not on the map: comparison i asks about the part s·u + t·v of the light, along the
// ray from the light's centre that meets the ray from there to the point at the blockers' distance. So a rectangle casts
// a rectangle's penumbra, whatever its direction, and a filter may reach over several faces of the cube.
//
// What blocks is nearer to the light, by the depth along its axis, and before the plane through the point (Isidoro 2006,
// receiver plane depth bias), taken at the texel's own centre: a plane does not shadow itself, however wide the filter.
#include "shadow_views.glsl"
#include "noise.glsl"
uniform sampler2D shadow_map;
uniform vec2 shadow_planes;  // distances of the near and the far plane
uniform vec3 light_u;        // half sides of the light's rectangle
uniform vec3 light_v;
uniform float light_size;    // not flat: half the side of a square that faces every point; else 0
uniform float search;

// The light as a point takes it.
struct Light {
    vec3 u, v; // half sides
    vec3 axis; // what depth is measured along
};

// Point i of so many that fill the square 0…1 evenly, and both its sides: a lattice by the golden ratio, moved round the
// square by a shift 0…1.
vec2 spread(int i, int count, vec2 shift) {
    return fract(float(i) * vec2(1.0 / float(count), 0.61803399) + shift);
}

// From the light's centre through the place where the ray from a point to a part of the light is `nearness` of the way
// from the light.
vec3 through(vec3 to_point, vec3 part, float nearness) {
    return nearness * to_point + (1.0 - nearness) * part;
}

// Distance along a view's axis of a depth 0…1.
float axial(float depth, float near, float far) {
    return near * far / (far - depth * (far - near));
}

// The ray through a place −1…1 on a view, of length 1 along its axis; a perspective view's rows are its axes.
vec3 ray_at(mat4 view, vec2 place) {
    vec3 right = vec3(view[0].x, view[1].x, view[2].x);
    vec3 up = vec3(view[0].y, view[1].y, view[2].y);
    vec3 axis = vec3(view[0].w, view[1].w, view[2].w);
    return axis + (place.x * right + place.y * up) / dot(right, right);
}

// How near the light the map's surface is on a ray, as a share of the way from the light to a point, along the light's
// axis; 1 where it does not block: where it is no nearer, or not before the plane through the point.
float nearness_on(vec3 ray, Light light, vec3 to_point, vec3 normal) {
    int view = cube_face(ray);
    vec3 coordinate;
    project(shadow_matrices[view], shadow_light.xyz + ray, coordinate);
    ivec2 texel = ivec2(coordinate.xy * float(RESOLUTION));
    float depth = texelFetch(shadow_map, texel + RESOLUTION * ivec2(view % COLUMNS, view / COLUMNS), 0).r;
    vec2 centre = (vec2(texel) + 0.5) / float(RESOLUTION) * 2.0 - 1.0;
    vec3 found = ray_at(shadow_matrices[view], centre) * axial(depth, shadow_planes.x, shadow_planes.y);
    float nearness = dot(found, light.axis) / dot(to_point, light.axis);
    bool blocks = depth < 1.0 && nearness < 1.0 && dot(found - to_point, normal) > 0.0;
#ifdef BETWEEN
    vec3 part = (found - nearness * to_point) / (1.0 - nearness);
    blocks = blocks && abs(dot(part, light.u)) <= dot(light.u, light.u) && abs(dot(part, light.v)) <= dot(light.v, light.v);
#endif
    return blocks ? nearness : 1.0;
}

vec3 visibility(Surface surface) {
    Receiver receiver;
    int view = view_of(surface.position);
    // Beyond its own horizon a point gets light from a part of the surface at most, and shading leaves the rest out.
    if (!receive(surface.position, surface.normal, view, 0.70710678, 0.0, receiver)) return vec3(1.0);
    vec3 to_point = receiver.position - shadow_light.xyz;
    Light light = Light(light_u, light_v, cross(light_u, light_v));
    if (light_size > 0.0) {
        vec3 across = abs(to_point.y) < 0.9 * length(to_point) ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
        light.u = light_size * normalize(cross(across, to_point));
        light.v = light_size * normalize(cross(to_point, light.u));
        light.axis = to_point;
    }
    vec2 pixel = floor(gl_FragCoord.xy);
    vec2 shift = vec2(interleaved_noise(pixel), interleaved_noise(pixel.yx + 101.0));
    float blockers = 0.0, sum = 0.0;
    for (int i = 0; i < SEARCH_SAMPLES; ++i) {
        vec2 part = 2.0 * spread(i, SEARCH_SAMPLES, shift) - 1.0;
#ifdef BETWEEN
        // Wherever on the way they may be: near the point only narrow rays find what lies between.
        float at = mix(search, 1.0, fract(float(i) * 0.75487767));
#else
        float at = search;
#endif
        vec3 ray = through(to_point, part.x * light.u + part.y * light.v, at);
        float nearness = nearness_on(ray, light, to_point, surface.normal);
        blockers += nearness < 1.0 ? 1.0 : 0.0;
        sum += nearness < 1.0 ? nearness : 0.0;
    }
    if (blockers == 0.0) return vec3(1.0);
    float lit = 0.0;
    for (int i = 0; i < SAMPLES; ++i) {
        vec2 part = 2.0 * spread(i, SAMPLES, shift) - 1.0;
        vec3 ray = through(to_point, part.x * light.u + part.y * light.v, sum / blockers);
        lit += nearness_on(ray, light, to_point, surface.normal) < 1.0 ? 0.0 : 1.0;
    }
    return vec3(lit / float(SAMPLES));
}
