// Radiance that other surfaces scatter here, from virtual lights.
#if TILE == 1
#include "received.glsl"

vec3 indirect(Surface surface) {
    return reflected(surface, 0, 1, LIGHTS);
}
#else
#include "interleaved.glsl"
uniform sampler2D interleaved; // what gather.frag found: for each pixel, from its own part of the lights

vec3 indirect(Surface surface) {
    vec3 sum = vec3(0.0);
    float count = 0.0;
    for (int i = 0; i < TILE * TILE; ++i) {
        ivec2 place = ivec2(gl_FragCoord.xy) + ivec2(i % TILE, i / TILE) - TILE / 2;
        Surface other;
        if (any(lessThan(place, ivec2(0))) || any(greaterThanEqual(place, textureSize(interleaved, 0)))) continue;
        if (!load_surface(place, other) || !alike(surface.normal, other.normal, other.position - surface.position)) continue;
        sum += texelFetch(interleaved, place, 0).rgb;
        count += 1.0;
    }
    return sum / max(count, 1.0) * tint(surface.base_color);
}
#endif
