// Rays over the screen: where they go, and how deep they are there. Depths are distances along the camera's axis.
uniform mat4 screen_from_world; // to clip space, sampled at the pixels' centres
uniform vec4 depth_plane;       // dot(depth_plane, (point, 1)) is the depth
uniform vec2 screen_size;       // pixels
uniform float nearest;          // the least depth seen

// A ray's part that can be seen.
struct ScreenRay {
    vec2 start, end;             // pixels, from the bottom left
    vec2 over_depth;             // 1/w at both ends
    vec2 depth_over;             // depth/w at both ends
    float share;                 // of the way to `end`: where the screen ends
};

// The share at which a ray leaves a rectangle of pixels that it starts before or in.
float exit_share(vec2 start, vec2 way, vec2 low, vec2 high) {
    vec2 limit = mix(low, high, greaterThan(way, vec2(0.0)));
    vec2 shares = mix((limit - start) / way, vec2(3.4e38), lessThan(abs(way), vec2(1e-6)));
    return min(shares.x, shares.y);
}

// The share of a segment that stays within 0…size; the start lies inside.
float inside_share(vec2 start, vec2 end, vec2 size) {
    return clamp(exit_share(start, end - start, vec2(0.0), size), 0.0, 1.0);
}

// The depth at a share of a segment on the screen: depth/w and 1/w are linear there (McGuire & Mara 2014, section 3).
float depth_at(float share, vec2 depth_over, vec2 over_depth) {
    return mix(depth_over.x, depth_over.y, share) / mix(over_depth.x, over_depth.y, share);
}

// How far a ray goes until it is as near as `least`, at most `reach`.
float visible_length(float depth, float change, float least, float reach) {
    return change < 0.0 ? clamp((least - depth) / change, 0.0, reach) : reach;
}
