// GGX in two forms, for a comparison: no effect uses this. `precise`: as written, not as a compiler mends it.

// Walter et al. 2007, eq. 33, as it is usually written: cos²·(α² − 1) + 1.
float ggx_textbook(vec3 n, vec3 h, float alpha) {
    float cosine = dot(n, h);
    float a2 = alpha * alpha;
    precise float d = cosine * cosine * (a2 - 1.0) + 1.0;
    return a2 / (d * d * 3.14159265);
}

// The same by |n × h|² (Guy & Agopian 2018, "Physically Based Rendering in Filament", section 4.4.1).
float ggx_cross(vec3 n, vec3 h, float alpha) {
    vec3 across = cross(n, h);
    float widened = dot(n, h) * alpha;
    float k = alpha / (dot(across, across) + widened * widened);
    return k * k * 0.318309886;
}
