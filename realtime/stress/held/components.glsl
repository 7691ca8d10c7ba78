// For genType = float, vec2, vec3, vec4; genBType = bool, bvec2, bvec3, bvec4.

genType held_product(genType a, genType b) {
    return held(a * b);
}

genType held_pow(genType x, genType y) {
    return held(exp2(held(y * held(log2(x)))));
}

genType held_mod(genType x, genType y) {
    return held(x - held(y * floor(held(x / y))));
}

genType held_mix(genType x, genType y, genType a) {
    return held(held(x * held(1.0 - a)) + held(y * a));
}

genType held_mix(genType x, genType y, genBType a) {
    return mix(x, y, a);
}

genType held_smoothstep(genType low, genType high, genType x) {
    genType t = clamp(held(held(x - low) / held(high - low)), 0.0, 1.0);
    return held(held(t * t) * held(3.0 - held(2.0 * t)));
}
