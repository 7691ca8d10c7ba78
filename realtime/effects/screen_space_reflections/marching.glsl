// How rays are marched through the depths of what the camera sees, and what became of them.
uniform float thickness; // metres behind a surface
uniform float reach;     // metres

const int NONE = 0;   // there was no ray
const int MET = 1;    // it met a surface
const int LEFT = 2;   // it left the screen, or came nearer than the camera sees
const int HIDDEN = 3; // it passed behind a surface, and met none after that
const int OPEN = 4;   // it went on in sight, or its steps ended, and it met none
int verdict = NONE;

float scene_depth(ivec2 pixel) {
    vec4 position = texelFetch(gbuffer_position, pixel, 0);
    return position.w > 0.0 ? dot(depth_plane, vec4(position.xyz, 1.0)) : 3.4e38;
}

ScreenRay screen_ray(vec3 origin, vec3 direction) {
    float depth = dot(depth_plane, vec4(origin, 1.0));
    float change = dot(depth_plane.xyz, direction);
    vec3 end = origin + visible_length(depth, change, nearest, reach) * direction;
    vec4 from = screen_from_world * vec4(origin, 1.0), to = screen_from_world * vec4(end, 1.0);
    ScreenRay ray;
    ray.over_depth = 1.0 / vec2(from.w, to.w);
    // The frame's samples may lie beside the pixels' centres: the pixel itself is where its ray starts.
    vec2 moved = gl_FragCoord.xy - (from.xy * ray.over_depth.x * 0.5 + 0.5) * screen_size;
    ray.start = gl_FragCoord.xy;
    ray.end = (to.xy * ray.over_depth.y * 0.5 + 0.5) * screen_size + moved;
    ray.depth_over = vec2(depth, dot(depth_plane, vec4(end, 1.0))) * ray.over_depth;
    ray.share = inside_share(ray.start, ray.end, screen_size);
    return ray;
}

float ray_depth(ScreenRay ray, float share) {
    return depth_at(share, ray.depth_over, ray.over_depth);
}

ivec2 pixel_at(ScreenRay ray, float share) {
    return clamp(ivec2(mix(ray.start, ray.end, share)), ivec2(0), ivec2(screen_size) - 1);
}

// What became of a ray that met nothing. One that comes to the nearest depth leaves the screen as well.
int unmet_verdict(ScreenRay ray, bool passed) {
    bool left = ray.share < 1.0 || ray_depth(ray, 1.0) <= nearest * 1.001;
    return passed ? HIDDEN : left ? LEFT : OPEN;
}

// Equal steps of a pixel or more; the step in which the ray goes behind a surface is halved.
int march_linear(ScreenRay ray, out vec2 place) {
    vec2 way = abs(ray.end - ray.start) * ray.share;
    float pixels = max(way.x, way.y);
    int count = int(min(float(STEPS), ceil(pixels)));
    bool passed = false;
    float before = min(1.0 / max(pixels, 1.0), 1.0) * ray.share * 0.5;
    place = ray.start;
    for (int i = 1; i <= count; ++i) {
        float after = ray.share * float(i) / float(count);
        float depth = scene_depth(pixel_at(ray, after));
        float ends = ray_depth(ray, after), starts = ray_depth(ray, before);
        if (max(ends, starts) > depth && any(notEqual(pixel_at(ray, after), ivec2(gl_FragCoord.xy)))) {
            float low = before, high = after;
            for (int j = 0; j < REFINEMENTS; ++j) {
                float middle = 0.5 * (low + high);
                if (ray_depth(ray, middle) > scene_depth(pixel_at(ray, middle))) high = middle;
                else low = middle;
            }
            float found = scene_depth(pixel_at(ray, high));
            if (min(ray_depth(ray, low), ray_depth(ray, high)) <= found + thickness) {
                place = mix(ray.start, ray.end, high);
                return MET;
            }
            passed = true;
        }
        before = after;
    }
    return unmet_verdict(ray, passed);
}

#ifdef HIERARCHICAL
uniform sampler2D least_depths;     // all levels, beside each other
uniform ivec4 level_places[LEVELS]; // left, bottom, width, height in texels

// Cells of the pyramid, coarse ones first: one that lies behind the ray wholly is skipped, else it is entered.
int march_hierarchical(ScreenRay ray, out vec2 place) {
    vec2 way = ray.end - ray.start;
    float pixels = max(abs(way.x), abs(way.y));
    place = ray.start;
    if (pixels < 1.0) return unmet_verdict(ray, false);
    float nudge = 0.01 / pixels; // into the next cell
    float at = exit_share(ray.start, way, floor(ray.start), floor(ray.start) + 1.0) + nudge;
    int level = 0;
    bool passed = false;
    for (int i = 0; i < STEPS && at < ray.share; ++i) {
        vec2 pixel = mix(ray.start, ray.end, at);
        float side = exp2(float(level));
        vec2 cell = floor(pixel / side);
        ivec4 tile = level_places[level];
        float depth = texelFetch(least_depths, tile.xy + clamp(ivec2(cell), ivec2(0), tile.zw - 1), 0).x;
        float leave = min(exit_share(ray.start, way, cell * side, (cell + 1.0) * side) + nudge, ray.share);
        float starts = ray_depth(ray, at), ends = ray_depth(ray, leave);
        if (max(starts, ends) < depth) {
            at = leave;
            level = min(level + 1, LEVELS - 1);
        } else if (level > 0) {
            --level;
        } else if (min(starts, ends) <= depth + thickness) {
            place = pixel;
            return MET;
        } else {
            passed = true;
            at = leave;
        }
    }
    return unmet_verdict(ray, passed);
}
#endif
