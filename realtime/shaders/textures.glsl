// The material's textures: a macro per slot that this permutation has, e.g. TEXTURE_BASE_COLOR.

// One coordinate under glTF's mirrored repeat, which not every driver layer can set on a sampler.
float mirrored(float x) {
    return 1.0 - abs(mod(x, 2.0) - 1.0);
}

vec2 transformed(vec2 uv, vec3 row_u, vec3 row_v) {
    return vec2(dot(row_u, vec3(uv, 1.0)), dot(row_v, vec3(uv, 1.0)));
}
