// The walls of a box in place of whatever stands around a cube map's centre.

// Where a ray from a point leaves an axis-aligned box, as seen from the centre (Lagarde & Zanuttini 2012, Local
// Image-based Lighting With Parallax-corrected Cubemaps).
vec3 towards_wall(vec3 point, vec3 direction, vec3 low, vec3 high, vec3 centre) {
    vec3 safe = mix(direction, vec3(1e-9), lessThan(abs(direction), vec3(1e-9)));
    vec3 exits = max((low - point) / safe, (high - point) / safe);
    return point + direction * min(exits.x, min(exits.y, exits.z)) - centre;
}
