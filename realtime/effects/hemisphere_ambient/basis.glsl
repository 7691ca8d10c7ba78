// How much of the light from a direction falls on what faces up (0) or down (1), over π.
float basis(int index, vec3 d) {
    return max(index == 0 ? d.y : -d.y, 0.0) * 0.3183098861837907;
}
