// The light of one slice through the direction to the viewer.

// ∫ cos(θ − γ)·|sin θ| dθ between the viewer's direction and an angle h from it, which is below 0 on the slice's other
// side; γ is the angle of the normal in the slice (Jimenez et al. 2016, eq. 7).
float arc(float h, float gamma) {
    return 0.25 * (cos(gamma) - cos(2.0 * h - gamma) + 2.0 * h * sin(gamma));
}

// How far along its way a step looks, 0…1: the square of even steps, as near places turn the horizon faster.
float step_share(float step, float count) {
    float share = step / count;
    return share * share;
}

// How far it is from a place within a rectangle at the origin to its edge, one way.
float edge_distance(vec2 place, vec2 way, vec2 size) {
    vec2 room = mix(place, size - place, step(0.0, way));
    vec2 distances = room / max(abs(way), vec2(1e-6));
    return min(distances.x, distances.y);
}
