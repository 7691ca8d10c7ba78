// Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited": tangent and normal are interpolated and not
// renormalised, the bitangent is made per pixel.
vec3 tangent_to_world(vec3 tangent, float bitangent_sign, vec3 normal, vec3 mapped) {
    vec3 bitangent = bitangent_sign * cross(normal, tangent);
    vec3 v = mapped.x * tangent + mapped.y * bitangent + mapped.z * normal;
    float square = dot(v, v);
    return square > 0.0 ? v * inversesqrt(square) : vec3(0.0);
}

// glTF 2.0, 3.9.3: 2t − 1, with x and y scaled.
vec3 decode_normal(vec3 texel, float scale) {
    return (2.0 * texel - 1.0) * vec3(scale, scale, 1.0);
}
