// The nearest half float, ties to even (IEEE 754, binary16): 11 bits; below 2⁻¹⁴ steps of 2⁻²⁴, or 0 where denormals
// are flushed; infinite from 65,520 up. Straight on, since compilers take long over branches.
float held(float x) {
#ifdef HALF
    uint bits = floatBitsToUint(x);
    // 1.5·2²³ steps: float32 rounds a sum with it to whole steps. Larger steps than that of 2⁻¹⁴ are a binade's 2¹⁰th.
    float many = max(uintBitsToFloat(bits & 0x7F800000u), 6.103515625e-5) * 12288.0;
    precise float size = (abs(x) + many) - many;
#ifdef FLUSH
    size = abs(x) < 6.103515625e-5 ? 0.0 : size;
#endif
    // Not the other way round: what is not a number is beyond the range, and stays so.
    size = size <= 65504.0 ? size : abs(x) * 3e38;
    return uintBitsToFloat(floatBitsToUint(size) | (bits & 0x80000000u));
#else
    return x;
#endif
}

vec2 held(vec2 v) {
    return vec2(held(v.x), held(v.y));
}

vec3 held(vec3 v) {
    return vec3(held(v.x), held(v.y), held(v.z));
}

vec4 held(vec4 v) {
    return vec4(held(v.x), held(v.y), held(v.z), held(v.w));
}
