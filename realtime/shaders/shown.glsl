// What the screen shows at a pixel; false off the screen, and where it shows no surface.
uniform ivec2 screen_size;

bool shown_at(ivec2 pixel, out vec3 position) {
    if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, screen_size))) return false;
    vec4 shown = fetch_place(pixel);
    position = shown.xyz;
    return shown.w > 0.0;
}
