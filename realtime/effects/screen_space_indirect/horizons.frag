// Light gathered over the screen: irradiance over π at each pixel, from what is lit so far.
#include "surface.glsl"
#include "noise.glsl"
#include "arcs.glsl"
uniform sampler2D scattered_light;
uniform vec3 camera_right;
uniform vec3 camera_up;
uniform float reach; // pixels
out vec4 gathered;

const float HALF_TURN = 3.14159265358979;

// What one side of a slice sends: a place shines over the angle by which it rises above those before it. What turns
// its back only hides.
vec3 gather_side(Surface surface, vec2 way, float side, float gamma, float shift) {
    vec3 sum = vec3(0.0);
    float horizon = gamma + side * 0.5 * HALF_TURN;
    ivec2 size = gbuffer_size();
    float farthest = min(reach, edge_distance(gl_FragCoord.xy, side * way, vec2(size)));
    for (int i = 0; i < STEPS; ++i) {
        float distant = max(farthest * step_share(float(i) + shift, float(STEPS)), float(i + 1));
        ivec2 place = ivec2(floor(gl_FragCoord.xy + side * way * distant));
        if (any(lessThan(place, ivec2(0))) || any(greaterThanEqual(place, size))) break;
        Surface other;
        bool front = load_surface(place, other);
        if (fetch_place(place).w == 0.0) continue;
        vec3 offset = other.position - surface.position;
        float square = dot(offset, offset);
        if (square == 0.0) continue;
        float angle = side * acos(clamp(dot(offset, surface.view) * inversesqrt(square), -1.0, 1.0));
        if (side * angle >= side * horizon) continue;
        if (front && dot(other.normal, offset) < 0.0) {
            sum += (arc(horizon, gamma) - arc(angle, gamma)) * texelFetch(scattered_light, place, 0).rgb;
        }
        horizon = angle;
    }
    return sum;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    Surface surface;
    bool seen = load_surface(pixel, surface);
    ivec2 cell = pixel % TILE;
    // Each pixel of a tile has directions of its own between those of the others, and steps of its own.
    float turned = (float(cell.y * TILE + cell.x) + 0.5) / float(TILE * TILE);
    float shift = 0.5 + 0.5 * interleaved_noise(vec2(cell));
    vec3 sum = vec3(0.0);
    for (int i = 0; i < SLICES; ++i) {
        float turn = (float(i) + turned) * (HALF_TURN / float(SLICES));
        vec2 way = vec2(cos(turn), sin(turn));
        vec3 along = camera_right * way.x + camera_up * way.y;
        vec3 axis = normalize(cross(along, surface.view));
        vec3 tangent = cross(surface.view, axis);
        vec3 projected = surface.normal - axis * dot(surface.normal, axis);
        float gamma = atan(dot(projected, tangent), dot(projected, surface.view));
        vec3 ahead = gather_side(surface, way, 1.0, gamma, shift);
        sum += length(projected) * (ahead + gather_side(surface, way, -1.0, gamma, shift));
    }
    gathered = vec4(seen ? sum / float(SLICES) : vec3(0.0), 0.0);
}
