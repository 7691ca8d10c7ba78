// The share of texels around a point that are not nearer to the light (Reeves, Salesin & Cook 1987): over a square, or
// at points of a disk that is turned from pixel to pixel, so that too few of them show as noise and not as bands
// (Isidoro 2006, Shadow Mapping: GPU-based Tips and Techniques).
#include "noise.glsl"
uniform sampler2D shadow_map; // the views beside each other, COLUMNS in a row
#ifdef DISK
uniform vec2 disk[DISK];      // points evenly in a disk of radius 1
uniform vec2 turns[TURNS];    // rotations by cosine and sine
uniform float radius;         // the disk's, texels
#define FILTER_MARGIN radius
#define FILTER_REACH (radius + 0.70710678)
#else
#define FILTER_MARGIN float(FILTER_RADIUS)
#define FILTER_REACH ((float(FILTER_RADIUS) + 0.5) * 1.41421356)
#endif

vec2 turned(vec2 point, vec2 turn) {
    return vec2(point.x * turn.x - point.y * turn.y, point.x * turn.y + point.y * turn.x);
}

// 1 where a texel is not nearer to the light than `depth`.
float compared(ivec2 texel, float depth) {
    return depth <= texelFetch(shadow_map, texel, 0).r ? 1.0 : 0.0;
}

// Views have a border as wide as the filter, so that no texel around a point within is another view's.
float filtered(vec3 coordinate, int view) {
    vec2 place = coordinate.xy * float(RESOLUTION);
    ivec2 tile = RESOLUTION * ivec2(view % COLUMNS, view / COLUMNS);
    float sum = 0.0;
#ifdef DISK
    vec2 turn = turns[int(interleaved_noise(floor(gl_FragCoord.xy)) * float(TURNS))];
    for (int i = 0; i < DISK; ++i)
        sum += compared(tile + ivec2(place + radius * turned(disk[i], turn)), coordinate.z);
    return sum / float(DISK);
#else
    ivec2 centre = tile + ivec2(place);
    for (int y = -FILTER_RADIUS; y <= FILTER_RADIUS; ++y)
        for (int x = -FILTER_RADIUS; x <= FILTER_RADIUS; ++x)
            sum += compared(centre + ivec2(x, y), coordinate.z);
    return sum / float((2 * FILTER_RADIUS + 1) * (2 * FILTER_RADIUS + 1));
#endif
}
