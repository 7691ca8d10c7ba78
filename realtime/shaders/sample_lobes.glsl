// Directions drawn from lobes about +Z, and how they are turned to a normal.

// Hammersley's points (Keller 1997, "Instant Radiosity"; the radical inverse in base 2), half a step from 0.
vec2 hammersley(int index, int count) {
    return vec2((float(index) + 0.5) / float(count),
                (float(bitfieldReverse(uint(index))) + 0.5) * 2.3283064365386963e-10);
}

// A half vector with density D·(n·h): GGX (Walter et al. 2007, eq. 35 and 36).
vec3 ggx_half_vector(vec2 u, float alpha) {
    float slope2 = alpha * alpha * u.x / (1.0 - u.x);
    float cosine = inversesqrt(1.0 + slope2);
    float sine = sqrt(slope2) * cosine;
    float turn = 6.28318530717959 * u.y;
    return vec3(sine * cos(turn), sine * sin(turn), cosine);
}

// A direction with density cos θ/π.
vec3 cosine_direction(vec2 u) {
    float turn = 6.28318530717959 * u.y;
    return vec3(sqrt(u.x) * vec2(cos(turn), sin(turn)), sqrt(1.0 - u.x));
}

// From about +Z to about n (Duff et al. 2017, "Building an Orthonormal Basis, Revisited", listing 3).
vec3 turned_to(vec3 n, vec3 local) {
    float side = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (side + n.z);
    float b = n.x * n.y * a;
    vec3 tangent = vec3(1.0 + side * n.x * n.x * a, side * b, -side * n.x);
    vec3 bitangent = vec3(b, side + n.y * n.y * a, -n.y);
    return tangent * local.x + bitangent * local.y + n * local.z;
}
