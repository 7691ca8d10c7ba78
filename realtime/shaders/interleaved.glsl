// What pixels that share out the virtual lights have in common.

// What the light is divided by before it is averaged over pixels, and multiplied by after: so textures stay sharp.
vec3 tint(vec3 base_color) {
    return max(base_color, vec3(0.01));
}

// Whether two pixels show one surface: normals within 26°, and the other no more than 12° off this one's plane.
bool alike(vec3 normal, vec3 other_normal, vec3 between) {
    float off = dot(normal, between);
    return dot(normal, other_normal) > 0.9 && off * off <= 0.04 * dot(between, between);
}
