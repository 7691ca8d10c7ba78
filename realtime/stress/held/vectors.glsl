// For vecN = vec2, vec3, vec4.

vecN held_product(vecN a, float b) {
    return held(a * b);
}

vecN held_product(float a, vecN b) {
    return held(a * b);
}

vecN held_mod(vecN x, float y) {
    return held_mod(x, vecN(y));
}

vecN held_mix(vecN x, vecN y, float a) {
    return held_mix(x, y, vecN(a));
}

vecN held_smoothstep(float low, float high, vecN x) {
    return held_smoothstep(vecN(low), vecN(high), x);
}

float held_dot(vecN a, vecN b) {
    vecN products = held(a * b);
    float sum = products[0];
    for (int i = 1; i < N; i++) sum = held(sum + products[i]);
    return sum;
}

float held_length(vecN v) {
    return held(sqrt(held_dot(v, v)));
}

float held_distance(vecN a, vecN b) {
    return held_length(held(a - b));
}

vecN held_normalize(vecN v) {
    return held(v * held(inversesqrt(held_dot(v, v))));
}

vecN held_reflect(vecN i, vecN n) {
    return held(i - held(held(2.0 * held_dot(n, i)) * n));
}

vecN held_refract(vecN i, vecN n, float eta) {
    float cosine = held_dot(n, i);
    float k = held(1.0 - held(held(eta * eta) * held(1.0 - held(cosine * cosine))));
    if (k < 0.0) return vecN(0.0);
    return held(held(eta * i) - held(held(held(eta * cosine) + held(sqrt(k))) * n));
}

vecN held_faceforward(vecN n, vecN i, vecN reference) {
    return held_dot(reference, i) < 0.0 ? n : -n;
}
