vec3 held_cross(vec3 a, vec3 b) {
    return held(held(a.yzx * b.zxy) - held(a.zxy * b.yzx));
}
