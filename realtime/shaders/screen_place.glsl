// Where on the screen, 0…1 from the lower left, a place in the world is; false behind the viewer.
bool screen_place(mat4 view_projection, vec3 place, out vec2 where) {
    vec4 clip = view_projection * vec4(place, 1.0);
    where = clip.xy / clip.w * 0.5 + 0.5;
    return clip.w > 0.0;
}
