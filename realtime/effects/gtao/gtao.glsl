// The horizons' visibility and bent normal, for both parts of what a surface reflects.
#include "occlusion_lookup.glsl"
#include "occluded_ambient.glsl"

// With what light between surfaces of one albedo gives back (Jimenez et al. 2016, eq. 10; every constant is theirs).
vec3 multi_bounce(float visibility, vec3 albedo) {
    vec3 a = 2.0404 * albedo - 0.3324;
    vec3 b = -4.7951 * albedo + 0.6417;
    vec3 c = 2.7552 * albedo + 0.6903;
    return max(vec3(visibility), ((visibility * a + b) * visibility + c) * visibility);
}

vec3 environment_visibility(Surface surface) {
    vec4 found = occlusion_at(surface, ivec2(gl_FragCoord.xy));
    vec3 bent = found.xyz * inversesqrt(max(dot(found.xyz, found.xyz), 1e-12));
    float visible = clamp(found.w, 0.0, 1.0);
    vec3 scattered = vec3(visible);
#ifdef MULTI_BOUNCE
    scattered = multi_bounce(visible, diffuse_color(surface.base_color, surface.metallic));
#endif
    return occluded_ambient(surface, scattered, visible, bent);
}
