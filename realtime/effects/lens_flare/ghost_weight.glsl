// How bright a ghost of what lies so far from the middle is, of 1 in the middle; 0 in the corners.
float ghost_weight(float away) {
    float near = max(1.0 - away / 0.70710678, 0.0);
    return near * near;
}
