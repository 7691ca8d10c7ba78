// The mean over a tile of pixels around this one of what each has found, of those that show this one's surface.
#include "interleaved.glsl"

vec3 tile_mean(sampler2D found, Surface surface) {
    vec3 sum = vec3(0.0);
    float count = 0.0;
    for (int i = 0; i < TILE * TILE; ++i) {
        ivec2 place = ivec2(gl_FragCoord.xy) + ivec2(i % TILE, i / TILE) - TILE / 2;
        Surface other;
        if (any(lessThan(place, ivec2(0))) || any(greaterThanEqual(place, textureSize(found, 0)))) continue;
        if (!load_surface(place, other) || !alike(surface.normal, other.normal, other.position - surface.position)) continue;
        sum += texelFetch(found, place, 0).rgb;
        count += 1.0;
    }
    return sum / max(count, 1.0);
}
