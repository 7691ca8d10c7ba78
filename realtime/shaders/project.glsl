// Window coordinates 0…1 of a point in one view; false behind the viewer.
bool project(mat4 view, vec3 point, out vec3 coordinate) {
    vec4 clip = view * vec4(point, 1.0);
    coordinate = clip.xyz / clip.w * 0.5 + 0.5;
    return clip.w > 0.0;
}
