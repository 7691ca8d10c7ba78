#include "noise.glsl"

// Bayer 1973: each of 64 thresholds once in 8 × 8 pixels, neighbours far apart: the bits of x ^ y and y, last ones first.
float ordered_threshold(vec2 pixel) {
    int y = int(pixel.y) & 7, q = (int(pixel.x) & 7) ^ y;
    int rank = (q & 1) << 5 | (y & 1) << 4 | (q & 2) << 2 | (y & 2) << 1 | (q & 4) >> 1 | (y & 4) >> 2;
    return (float(rank) + 0.5) / 64.0;
}
