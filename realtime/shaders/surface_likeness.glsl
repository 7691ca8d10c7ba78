// How alike the surface at another pixel is, 0…1: `offset` away in the world, of the normal `other`. It lies in the same
// plane up to `thickness` and looks the same way.
float surface_likeness(vec3 offset, vec3 normal, vec3 other, float thickness) {
    float facing = max(dot(normal, other), 0.0);
    float facing2 = facing * facing;
    return max(1.0 - abs(dot(offset, normal)) / thickness, 0.0) * facing2 * facing2;
}
