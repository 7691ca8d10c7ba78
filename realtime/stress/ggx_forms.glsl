// GGX in two forms, for a comparison: no effect uses this. Every operation is rounded by `held`: with HALF to a half
// float, held within its range; with FLUSH a denormal one becomes 0. `precise`: as written, not as a compiler mends it.
const float INVERSE_PI = 0.318309886;

float held(float x) {
#ifdef HALF
    if (abs(x) < 6.103515625e-5) {
#ifdef FLUSH
        return 0.0;
#else
        return roundEven(x * 16777216.0) / 16777216.0;
#endif
    }
    if (abs(x) > 65504.0) return sign(x) * 65504.0;
    uint bits = floatBitsToUint(x);
    return uintBitsToFloat((bits + 0xFFFu + ((bits >> 13u) & 1u)) & ~0x1FFFu);
#else
    return x;
#endif
}

vec3 held(vec3 v) {
    return vec3(held(v.x), held(v.y), held(v.z));
}

float scalar_product(vec3 a, vec3 b) {
    vec3 products = held(a * b);
    return held(held(products.x + products.y) + products.z);
}

// Walter et al. 2007, eq. 33, as it is usually written: cos²·(α² − 1) + 1.
float ggx_textbook(vec3 n, vec3 h, float alpha) {
    vec3 normal = held(n), half_vector = held(h);
    precise float a = held(alpha);
    precise float cosine = scalar_product(normal, half_vector);
    precise float a2 = held(a * a);
    precise float less = held(a2 - 1.0);
    precise float square = held(cosine * cosine);
    precise float scaled = held(square * less);
    precise float d = held(scaled + 1.0);
    precise float area = held(held(d * d) * 3.14159265);
    return held(a2 / area);
}

// The same by |n × h|² (Guy & Agopian 2018, "Physically Based Rendering in Filament", section 4.4.1).
float ggx_cross(vec3 n, vec3 h, float alpha) {
    vec3 normal = held(n), half_vector = held(h);
    precise float a = held(alpha);
    precise vec3 across = held(held(normal.yzx * half_vector.zxy) - held(normal.zxy * half_vector.yzx));
    precise float sin2 = scalar_product(across, across);
    precise float widened = held(scalar_product(normal, half_vector) * a);
    precise float k = held(a / held(sin2 + held(widened * widened)));
    return held(held(k * k) * INVERSE_PI);
}
