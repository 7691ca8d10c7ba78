// For N = 2, 3, 4, column by column.

matN held(matN m) {
    for (int i = 0; i < N; i++) m[i] = held(m[i]);
    return m;
}

matN held_product(matN m, float x) {
    return held(m * x);
}

matN held_product(float x, matN m) {
    return held(m * x);
}

vecN held_product(matN m, vecN v) {
    vecN sum = held(m[0] * v[0]);
    for (int i = 1; i < N; i++) sum = held(sum + held(m[i] * v[i]));
    return sum;
}

vecN held_product(vecN v, matN m) {
    vecN found;
    for (int i = 0; i < N; i++) found[i] = held_dot(v, m[i]);
    return found;
}

matN held_product(matN a, matN b) {
    for (int i = 0; i < N; i++) b[i] = held_product(a, b[i]);
    return b;
}
